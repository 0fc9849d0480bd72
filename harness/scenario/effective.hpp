// The effective scenario: all defaults are stated, and the form is canonical.
#pragma once

#include <string>

#include "harness/scenario/scenario.hpp"

namespace scanbench::harness {

/// The scenario as YAML, with every default and the world written out. Loading the text again, from any folder, gives
/// the same scenario, the same text, and the same bytes in every artefact.
std::string effective_yaml(const Scenario& scenario);

}  // namespace scanbench::harness
