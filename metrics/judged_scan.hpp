// Compares the lines found in one scan with its true lines, by the parameters of the metric family `segments`. Figures
// show the same verdicts.
#pragma once

#include <cstdint>
#include <vector>

#include "core/params.hpp"
#include "metrics/line_matching.hpp"

namespace scanbench::metrics {

/// The parameters of the family `segments`.
struct SegmentRules {
  int min_beams = 9;
  double min_length_m = 0.5;
  double max_angle_deg = 10.0;
  double max_offset_m = 0.15;
  double min_overlap = 0.5;
  static auto fields() {
    return std::tuple{
        field("min_beams", &SegmentRules::min_beams, at_least(2), "", "fewest returns of a true line"),
        field("min_length_m", &SegmentRules::min_length_m, at_least(0), "m",
              "shortest true line; shorter found lines that match nothing are ignored"),
        field("max_angle_deg", &SegmentRules::max_angle_deg, between(0, 90), "deg", "largest angle of a match"),
        field("max_offset_m", &SegmentRules::max_offset_m, at_least(0), "m",
              "largest distance of a match's midpoint from the true line"),
        field("min_overlap", &SegmentRules::min_overlap, between(0, 1), "",
              "share of the shorter line that must overlap")};
  }
  MatchRule match_rule() const;
};

struct JudgedScan {
  std::vector<TrueLine> truths;
  LineMatching matching;

  std::int64_t count(Outcome outcome) const;
  std::int64_t missed() const;  ///< true lines without a match
  /// 2 matches / (found lines + true lines), without found lines that are ignored or too_small; NaN if there are
  /// neither.
  double f1() const;
};

/// Matches found lines with true lines, and then the false ones, each with at most one and by the same rule, with what
/// the scan shows of walls in pieces too small to be true lines, of at least three returns: those that match are
/// `too_small`. The input must satisfy has_beam_truth().
JudgedScan judge_scan(const MetricInput& input, std::size_t frame, const Surfaces& surfaces, const SegmentRules& rules);

}  // namespace scanbench::metrics
