// The simulator's input for a scenario.
#pragma once

#include <cstdint>

#include "harness/scenario/scenario.hpp"
#include "sim/simulate.hpp"

namespace scanbench::harness {

/// The input of simulate(). Its trajectory has the waypoints that figures show. Throws InternalError for a scenario
/// that is not simulated.
sim::SimulationInput simulation_input(const Scenario& scenario, std::uint64_t seed);

}  // namespace scanbench::harness
