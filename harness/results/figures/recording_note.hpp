// What a reader of a figure must know of its recording: seed, tilt, errors of the poses.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "harness/study/scenario/scenario.hpp"

namespace scanbench::results {

/// A sentence for captions: "Simulated with seed 1; poses by odometry with errors.", "Simulated with 20 seeds; ...",
/// "Recorded log intel.log.gz, its reference poses." `seeds`: those that are shown.
std::string recording_note(const study::Scenario& scenario, std::span<const std::uint64_t> seeds);

/// What decides how hard a simulated scenario is: "sensor ladar_2d30, range noise 5 cm"; "recorded log", or empty for
/// lines instead of scans.
std::string condition_text(const study::Scenario& scenario);

/// A sentence for pages: ratios to bounds are to those of a still, level sensor. Empty if the scenario's sensor is one,
/// or if no metric of the scenario has a bound.
std::string bound_note(const study::Scenario& scenario);

/// The same as recording_note() for titles, only what is unusual: "tilted sensor, seed 3 of 20 seeds"; empty if nothing
/// is.
std::string recording_title_note(const study::Scenario& scenario, std::span<const std::uint64_t> seeds);

}  // namespace scanbench::results
