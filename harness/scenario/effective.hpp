// The effective scenario: all defaults are stated, and the form is canonical.
#pragma once

#include <string>

#include "harness/scenario/scenario.hpp"

namespace scanbench::harness {

/// Paths of copies of a scenario's files, relative to the folder of its effective.yaml. Empty: there is no copy.
struct StoredInputs {
  std::string published;
  std::string lines;
};

/// The scenario as YAML, with every default and the world written out. It names the copies; every other path is
/// absolute. Loading the text again, from any folder if there are no copies, gives the same scenario, the same text,
/// and the same bytes in every artefact.
std::string effective_yaml(const Scenario& scenario, const StoredInputs& stored = {});

}  // namespace scanbench::harness
