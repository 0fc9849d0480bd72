// module new: writes the file of a new module, which works and passes the conformance suite, for its author to change.
#include "app/authoring/new_module.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/authoring/module_templates.hpp"
#include "core/error.hpp"
#include "core/names.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/study/catalog/find_module.hpp"

namespace scanbench::app {
namespace {

namespace fs = std::filesystem;

void check_name(const std::string& kind, const std::string& name) {
  const auto small = [](char c) { return c >= 'a' && c <= 'z'; };
  const auto allowed = [&](char c) { return small(c) || (c >= '0' && c <= '9') || c == '_'; };
  if (name.empty() || name.size() > 60 || !small(name.front()) || name.back() == '_' ||
      name.find("__") != std::string::npos || !std::ranges::all_of(name, allowed))
    throw ConfigError("the name is '" + name +
                      "'; allowed: up to 60 small letters, digits and single _, beginning with a letter: my_lines");
  const auto known = study::module_names(kind);
  if (std::ranges::count(known, name) > 0)
    throw ConfigError("there is a module '" + name + "' of the kind " + kind + " already; give another name");
}

int write_module(const std::string& kind, const std::string& name, const fs::path& sources) {
  const auto kinds = template_kinds();
  if (std::ranges::count(kinds, kind) == 0) {
    const bool is_folder = !kind.empty() && fs::is_directory(sources / "algorithms" / kind);
    throw ConfigError(is_folder
                          ? "there is no template for modules of the kind " + kind + "; there are: " + join(kinds) +
                                "; begin with a copy of a file of " + (fs::path("algorithms") / kind).string()
                          : "there is no kind of module '" + kind + "'" + known_names(kind, kinds));
  }
  check_name(kind, name);
  const fs::path folder = sources / "algorithms" / kind;
  if (!fs::is_directory(sources / "algorithms"))
    throw ConfigError(sources.string() +
                      " is not the folder of scanbench's sources: it has no algorithms/; go there, or name it with "
                      "--sources");
  const fs::path file = folder / (name + ".cpp");
  if (fs::exists(fs::symlink_status(file))) throw ConfigError(file.string() + " exists already; give another name");
  io::make_folders(folder);
  io::write_file_atomically(file, module_source(kind, name));
  fmt::print("{}\n", file.lexically_normal().string());
  fmt::print(
      "./scanbench test --module {} builds it and runs the conformance suite on it; docs/write-a-module.md says "
      "what goes into it\n",
      name);
  return kGood;
}

struct NewModuleOptions {
  std::string kind, name, sources = ".";
};

}  // namespace

void add_new_module(Verb& module) {
  auto options = std::make_shared<NewModuleOptions>();
  Verb verb = module.add_verb("new", "Writes the file of a new module, to be changed by its author");
  verb.option("KIND", options->kind, join(template_kinds())).required().completed_by(template_kinds);
  verb.option("NAME", options->name, "the module's name in small letters, digits and _").required();
  verb.option("--sources", options->sources, "the folder of scanbench's sources").shows_default();
  verb.runs([options] { return write_module(options->kind, options->name, options->sources); });
}

}  // namespace scanbench::app
