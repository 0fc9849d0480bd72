// Makes a new module of an example by giving it another name.
#include "app/authoring/module_templates.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <iterator>

#include "core/error.hpp"
#include "core/names.hpp"
#include "module_template_texts.hpp"  // written by cmake/embed_templates.cmake

namespace scanbench::app {
namespace {

/// The name of a template's module, from the comment in its first line: "// my_lines: one line through all returns."
std::string_view name_in(std::string_view text) {
  constexpr std::string_view kBegin = "// ";
  const std::size_t end = text.find(':');
  SCANBENCH_ASSERT(text.starts_with(kBegin) && end != std::string_view::npos);
  return text.substr(kBegin.size(), end - kBegin.size());
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

std::string camel_case(std::string_view name) {
  std::string result;
  bool begins_word = true;
  for (const char c : name) {
    if (c != '_') result += begins_word ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    begins_word = c == '_';
  }
  return result;
}

}  // namespace

std::vector<std::string> template_kinds() {
  std::vector<std::string> kinds;
  kinds.reserve(std::size(kModuleTemplates));
  for (const ModuleTemplate& each : kModuleTemplates) kinds.emplace_back(each.kind);
  return kinds;
}

std::string module_source(std::string_view kind, std::string_view name) {
  const auto* const found = std::ranges::find(kModuleTemplates, kind, &ModuleTemplate::kind);
  if (found == std::end(kModuleTemplates))
    throw ConfigError("there is no template for the kind '" + std::string(kind) + "'" +
                      known_names(kind, template_kinds()));
  std::string text(found->text);
  const std::string example(name_in(found->text));
  replace_all(text, example, name);
  replace_all(text, camel_case(example), camel_case(name));
  return text;
}

}  // namespace scanbench::app
