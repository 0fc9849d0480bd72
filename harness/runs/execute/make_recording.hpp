// Makes the recording of a scenario.
#pragma once

#include <cstdint>
#include <functional>

#include "core/recording.hpp"
#include "harness/study/scenario/scenario.hpp"
#include "harness/study/scenario/simulation_input.hpp"

namespace scanbench::runs {

/// Checks what loading does not: that the path is clear of walls and the sensor in range of one, that the memory
/// suffices, and that the log can be read. Throws ConfigError.
void check_scenario(const study::Scenario& scenario);

/// The recording of a scenario for one seed: simulates, or reads the log (the seed is then unused). Throws ConfigError
/// if it would need more memory than the limit; the message shows the calculation.
Recording make_recording(const study::Scenario& scenario, std::uint64_t seed, int threads,
                         const std::function<void(double)>& progress = {});

}  // namespace scanbench::runs
