// The simulator's input for a scenario.
#pragma once

#include <string>

#include <cstdint>

#include "harness/study/scenario/scenario.hpp"
#include "sim/simulate.hpp"

namespace scanbench::study {

/// The input of simulate(). Its trajectory has the waypoints that figures show. Throws InternalError for a scenario
/// that is not simulated.
sim::SimulationInput simulation_input(const Scenario& scenario, std::uint64_t seed);

/// "file:line:column" of the scenario's waypoints, or of its trajectory, for a message about its path; the file alone
/// if the text of the scenario has no trajectory.
std::string trajectory_place(const Scenario& scenario);

}  // namespace scanbench::study
