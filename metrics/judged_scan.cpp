// Matching of one scan, and the counts that follow from it.
#include "metrics/judged_scan.hpp"

#include <algorithm>

#include "metrics/rows.hpp"

namespace scanbench::metrics {

MatchRule SegmentRules::match_rule() const {
  return {.max_angle_rad = radians(max_angle_deg),
          .max_offset_m = max_offset_m,
          .min_overlap = min_overlap,
          .min_length_m = min_length_m};
}

std::int64_t JudgedScan::count(Outcome outcome) const {
  return std::ranges::count(matching.outcome, outcome);
}

std::int64_t JudgedScan::missed() const {
  return std::ssize(truths) - count(Outcome::true_line);
}

double JudgedScan::f1() const {
  const std::int64_t judged = std::ssize(matching.outcome) - count(Outcome::ignored);
  return ratio(2.0 * number(count(Outcome::true_line)), number(judged + std::ssize(truths)));
}

JudgedScan judge_scan(const MetricInput& input, std::size_t frame, const Surfaces& surfaces,
                      const SegmentRules& rules) {
  JudgedScan judged;
  judged.truths =
      true_lines(input, frame, surfaces, {.min_beams = rules.min_beams, .min_length_m = rules.min_length_m});
  judged.matching = match_lines(input.result.lines[frame].lines, judged.truths, rules.match_rule());
  return judged;
}

}  // namespace scanbench::metrics
