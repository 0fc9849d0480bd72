// What the simulator gets of a scenario.
#pragma once

#include <cstdint>

#include "harness/scenario/scenario.hpp"
#include "sim/simulate.hpp"

namespace scanbench::harness {

/// What simulate() gets; its trajectory has the waypoints that figures show. Only for scenarios with a simulated world.
sim::SimulationInput simulation_input(const Scenario& scenario, std::uint64_t seed);

}  // namespace scanbench::harness
