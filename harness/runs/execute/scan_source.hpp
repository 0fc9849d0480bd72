// The scans of a scenario before it is run: how many there are, and recordings of a few of them.
#pragma once

#include <cstddef>
#include <optional>

#include "core/recording.hpp"
#include "harness/study/scenario/scenario.hpp"
#include "sim/simulate.hpp"

namespace scanbench::runs {

class ScanSource {
 public:
  /// Of the scenario's first seed. Reads a log, but simulates nothing. Throws what check_scenario() and
  /// make_recording() throw.
  explicit ScanSource(const study::Scenario& scenario);

  std::size_t scans() const { return scans_; }
  double rays() const { return rays_; }                        ///< readings of all scans
  double reading_seconds() const { return reading_seconds_; }  ///< that reading the log took; 0 if there is none

  /// `count` scans, at most all, that follow each other in the middle.
  Recording sample(std::size_t count, int threads) const;

 private:
  sim::SimulationInput input_{};
  std::optional<Recording> recording_;  ///< of a log or of lines
  std::size_t scans_ = 0;
  double rays_ = 0.0;
  double reading_seconds_ = 0.0;
};

}  // namespace scanbench::runs
