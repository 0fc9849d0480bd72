// Matching of one scan, and the counts that follow from it.
#include "metrics/judged_scan.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

#include "metrics/rows.hpp"

namespace scanbench::metrics {
namespace {

// Any two returns are on a line, so a piece needs three.
constexpr TrueLineRule kAnyPiece{.min_beams = 3, .min_length_m = 0.0};

// Of the false lines, those that match a piece of a wall are too small to be judged. No false line matches a piece that
// is large enough: that piece is a true line.
void excuse_small(std::span<const LineFeature> found, std::span<const TrueLine> pieces, const MatchRule& rule,
                  LineMatching& matching) {
  std::vector<LineFeature> false_lines;
  std::vector<std::size_t> numbers;
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (matching.outcome[k] != Outcome::false_line) continue;
    false_lines.push_back(found[k]);
    numbers.push_back(k);
  }
  const LineMatching with_pieces = match_lines(false_lines, pieces, rule);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (with_pieces.outcome[i] == Outcome::true_line) matching.outcome[numbers[i]] = Outcome::too_small;
}

}  // namespace

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
  const std::int64_t judged = std::ssize(matching.outcome) - count(Outcome::ignored) - count(Outcome::too_small);
  return ratio(2.0 * number(count(Outcome::true_line)), number(judged + std::ssize(truths)));
}

JudgedScan judge_scan(const MetricInput& input, std::size_t frame, const Surfaces& surfaces,
                      const SegmentRules& rules) {
  JudgedScan judged;
  judged.truths =
      true_lines(input, frame, surfaces, {.min_beams = rules.min_beams, .min_length_m = rules.min_length_m});
  const std::vector<LineFeature>& found = input.result.lines[frame].lines;
  judged.matching = match_lines(found, judged.truths, rules.match_rule());
  excuse_small(found, true_lines(input, frame, surfaces, kAnyPiece), rules.match_rule(), judged.matching);
  return judged;
}

}  // namespace scanbench::metrics
