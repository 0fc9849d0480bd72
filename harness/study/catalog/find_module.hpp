// Lookup of modules of any kind by name, over the registries of all interfaces.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/params.hpp"
#include "core/registry.hpp"
#include "harness/study/catalog/pipeline_spec.hpp"

namespace scanbench::study {

/// A module without its interface.
struct ModuleEntry {
  const ModuleInfo& info;
  const std::vector<ParamSpec>& params;
};

/// The slots of the chain (chain.hpp), then metrics, figure, trajectory.
const std::vector<std::string>& module_kinds();

/// Alphabetical. Throws ConfigError for an unknown kind.
std::vector<std::string> module_names(std::string_view kind);

/// Finds a module. Throws ConfigError for an unknown kind or name, and names the known ones.
ModuleEntry find_module(std::string_view kind, std::string_view name);

/// What is known of a chosen module, registered or foreign. It refers to the choice. Throws ConfigError for a name that
/// is not registered.
ModuleEntry entry_of(const ModuleChoice& choice);

/// Constructs the module and discards it, to check its parameters. Throws ParamError for parameters that contradict
/// each other.
void try_module(std::string_view kind, std::string_view name, const ParamSet& params);

}  // namespace scanbench::study
