// Runs extractors in tests, on random scans among others.
#pragma once

#include <string>
#include <vector>

#include "core/modules.hpp"
#include "core/registry.hpp"
#include "tests/support/scan_builder.hpp"

namespace scanbench::support {

inline ScanLines extract(std::string_view module, const OwnedScan& scan, const ParamSet& params = {}) {
  Trace silent;
  return Registry<LineExtractor>::make(module, params)->extract(scan.view(), silent);
}

/// Runs of labels as (first beam, last beam), one per line; for extractors whose supports are runs.
inline std::vector<std::pair<int, int>> beam_runs(const ScanLines& lines) {
  std::vector<std::pair<int, int>> runs;
  for (const LineFeature& f : lines.lines) runs.emplace_back(f.first_beam, f.last_beam);
  return runs;
}

/// A 361-beam full-turn scan of random_room(seed), noise 1 to 5 cm.
inline OwnedScan random_scan(std::uint64_t seed) {
  const double sigma = 0.01 * static_cast<double>(1 + seed % 5);
  return with_noise(cast(ring_sensor(361), random_room(seed)), sigma, seed);
}

/// The mirror image of a scan: beams in reverse order at mirrored angles, every point at (x, -y).
inline OwnedScan mirrored(const OwnedScan& scan) {
  OwnedScan result = scan;
  const ScanGeometry& g = scan.sensor.geometry;
  result.sensor.geometry = ScanGeometry(-g.angle(g.beams() - 1), g.angle_step(), g.beams());
  result.ranges.assign(scan.ranges.rbegin(), scan.ranges.rend());
  result.ids.assign(scan.ids.rbegin(), scan.ids.rend());
  return result;
}

}  // namespace scanbench::support
