// Pipelines as they are requested: modules by name, each with all of its parameters.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/params.hpp"
#include "harness/study/foreign/source.hpp"

namespace scanbench::study {

/// A module with all of its parameters.
struct ModuleChoice {
  std::string kind;  ///< a slot of the chain (chain.hpp), or metrics, figure, trajectory
  std::string module;
  ParamSet params;
  std::optional<ForeignSource> source = {};  ///< absent: the module is registered in this program
};

struct PipelineSpec {
  std::string name;
  std::vector<ModuleChoice> slots;  ///< in the order of the chain (chain.hpp)
  std::string published;            ///< the method's name in Scenario::published_file; may be empty
};

}  // namespace scanbench::study
