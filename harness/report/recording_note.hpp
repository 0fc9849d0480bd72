// What a reader of a figure must know of its recording: seed, tilt, errors of the poses.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "harness/scenario/scenario.hpp"

namespace scanbench::harness {

/// A sentence for captions: "Simulated with seed 1; poses by odometry with errors.", "Simulated with 20 seeds; ...",
/// "Recorded log intel.log.gz, its reference poses." `seeds`: those that are shown.
std::string recording_note(const Scenario& scenario, std::span<const std::uint64_t> seeds);

/// The same for titles, only what is unusual: "tilted sensor, seed 3 of 20 seeds"; empty if nothing is.
std::string recording_title_note(const Scenario& scenario, std::span<const std::uint64_t> seeds);

}  // namespace scanbench::harness
