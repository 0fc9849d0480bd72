// The registries of all kinds of modules behind one name: what a scenario file, `list` and `describe` look things up
// in.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/registry.hpp"

namespace scanbench::harness {

/// A registered module without its interface.
struct ModuleEntry {
  const ModuleInfo& info;
  const std::vector<ParamSpec>& params;
};

/// extract, align, match, map, merge, metrics, figure, trajectory.
const std::vector<std::string>& module_kinds();

/// The slots of a pipeline in the order of its chain.
const std::vector<std::string>& slot_kinds();

/// Alphabetical. Throws ConfigError for an unknown kind.
std::vector<std::string> module_names(std::string_view kind);

/// The module; throws ConfigError for an unknown kind or name, naming the known ones.
ModuleEntry find_module(std::string_view kind, std::string_view name);

/// Makes the module and drops it: throws ParamError for parameters that do not go together.
void try_module(std::string_view kind, std::string_view name, const ParamSet& params);

}  // namespace scanbench::harness
