// Scans with their lines for tests of aligners and matchers.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "core/registry.hpp"
#include "tests/support/scan_builder.hpp"

namespace scanbench::support {

/// The lines of a scan without noise: one from the first to the last point of each run of beams that hit the same
/// wall.
inline ScanLines exact_lines(const OwnedScan& scan) {
  ScanLines result;
  result.labels.assign(scan.ranges.size(), -1);
  const Scan view = scan.view();
  for (std::size_t i = 0; i < scan.ids.size();) {
    std::size_t end = i + 1;
    while (end < scan.ids.size() && scan.ids[end] == scan.ids[i]) ++end;
    if (scan.ids[i] >= 0 && end - i >= 2) {
      const Segment s{view.point(static_cast<int>(i)), view.point(static_cast<int>(end) - 1)};
      for (std::size_t k = i; k < end; ++k) result.labels[k] = static_cast<int>(result.lines.size());
      result.lines.push_back({.segment = s,
                              .line = line_through(s.a, s.b),
                              .covariance = {},
                              .first_beam = static_cast<int>(i),
                              .last_beam = static_cast<int>(end) - 1,
                              .points = static_cast<int>(end - i)});
    }
    i = end;
  }
  return result;
}

/// Owns the scans and lines that its observations refer to.
class ScanSeries {
 public:
  void add(OwnedScan scan, ScanLines lines) {
    scans_.push_back(std::make_unique<Held>(std::move(scan), std::move(lines)));
  }
  void add_exact(OwnedScan scan) {
    ScanLines lines = exact_lines(scan);
    add(std::move(scan), std::move(lines));
  }
  /// Adds a scan with the lines that an extractor finds.
  void add_extracted(OwnedScan scan, std::string_view extractor = "kovesi", const ParamSet& params = {}) {
    Trace silent;
    ScanLines lines = Registry<LineExtractor>::make(extractor, params)->extract(scan.view(), silent);
    add(std::move(scan), std::move(lines));
  }

  std::size_t size() const { return scans_.size(); }
  std::vector<Observation> observations() const {
    std::vector<Observation> result;
    for (const auto& held : scans_) result.push_back({held->view, held->lines});
    return result;
  }

 private:
  struct Held {
    Held(OwnedScan s, ScanLines l) : scan(std::move(s)), view(scan.view()), lines(std::move(l)) {}
    OwnedScan scan;
    Scan view;
    ScanLines lines;
  };
  std::vector<std::unique_ptr<Held>> scans_;
};

inline Alignment align(std::string_view module, const ScanSeries& scans, const std::vector<Pose2>& initial,
                       const ParamSet& params = {}) {
  Trace silent;
  return Registry<Aligner>::make(module, params)->align(scans.observations(), initial, silent);
}

}  // namespace scanbench::support
