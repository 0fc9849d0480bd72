// The effective scenario: every default written out, in one canonical form.
#pragma once

#include <string>

#include "harness/scenario/scenario.hpp"

namespace scanbench::harness {

/// The scenario with every default written out, the world in it, in one canonical form; loading it again, from any
/// folder, gives the same scenario, the same bytes of this text and of every artefact.
std::string effective_yaml(const Scenario& scenario);

}  // namespace scanbench::harness
