// Reads options about foreign modules.
#include "app/foreign.hpp"

#include "core/error.hpp"
#include "harness/io/files/input_file.hpp"
#include "harness/study/foreign/fault.hpp"
#include "harness/study/foreign/inspect.hpp"

namespace scanbench::app {
namespace {

/// A path as a scalar of YAML in single quotes.
std::string quoted(const std::string& path) {
  std::string text;
  for (const char c : path) text += c == '\'' ? std::string("''") : std::string(1, c);
  return "'" + text + "'";
}

}  // namespace

void add_foreign_options(Verb& verb, ForeignOptions& options, bool programs) {
  verb.option("--plugin", options.plugins, "a shared library of modules (docs/plugins.md)").one_value_each();
  if (programs)
    verb.option("--program", options.program, "a program that is a module, and its arguments").values(1, 100);
}

std::vector<std::string> with_foreign(std::vector<std::string> sets, const ForeignOptions& options, bool sandbox) {
  std::string list;
  for (const std::string& plugin : options.plugins) list += (list.empty() ? "" : ", ") + quoted(plugin);
  if (!list.empty()) sets.push_back("plugins=[" + list + "]");
  if (sandbox) sets.emplace_back("limits.sandbox=true");
  return sets;
}

std::vector<study::ForeignSource> foreign_sources(const ForeignOptions& options) {
  std::vector<study::ForeignSource> sources;
  try {
    for (const std::string& plugin : options.plugins) {
      const io::InputFile file(plugin);  // refuses what is not a regular file
      for (auto& source : study::inspect_library(plugin)) sources.push_back(std::move(source));
    }
    if (!options.program.empty()) {
      study::ForeignSource source;
      source.program = options.program;
      study::inspect_program(source, false);
      sources.push_back(std::move(source));
    }
  } catch (const study::ForeignFault& fault) {
    throw ConfigError(fault.what());
  }
  return sources;
}

std::vector<results::CatalogEntry> foreign_entries(const ForeignOptions& options) {
  std::vector<results::CatalogEntry> entries;
  for (const auto& source : foreign_sources(options)) {
    const study::ForeignModule& module = source.module;
    entries.push_back({module.kind, module.info, module.params, {}});
    if (!module.version.empty()) entries.back().notes.push_back("version " + module.version);
    entries.back().notes.push_back("from " + source.text());
  }
  return entries;
}

}  // namespace scanbench::app
