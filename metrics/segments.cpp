// segments: compares the found lines of each scan with the true ones: which are true, split, merged, false or missed,
// and how exact the true ones are. After the region measures of Hoover et al., "An experimental comparison of range
// image segmentation algorithms", PAMI 1996, applied to the lines of a scan.
//
// A line that is right on a wall too small to be a true line is neither right nor false, as detection benchmarks treat
// objects that are too small to be required (Everingham et al., "The Pascal visual object classes challenge", IJCV
// 2010, section 3: "difficult" objects): a single return can decide whether the wall counts. `n_small` is the number of
// these lines; `precision_strict` and `f1_strict` count them as false.
//
// A merged line is also true for one of its walls; the other wall counts as missed. A wall that a body in front of it
// cuts in two makes two true lines: one found line across both leaves one of them missed.
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/index.hpp"
#include "core/registry.hpp"
#include "metrics/judged_scan.hpp"
#include "metrics/rows.hpp"

namespace scanbench::metrics {
namespace {

constexpr const char* kScans = "scans";  // scans.csv

// Root mean square distance of the returns from the lines that they support; NaN without any.
double residual(const Scan& scan, const ScanLines& found) {
  Mean squares;
  for (int beam = 0; beam < scan.beams(); ++beam) {
    const int line = found.labels[as_index(beam)];
    if (line < 0 || !scan.valid(beam)) continue;
    const double distance = found.lines[as_index(line)].line.signed_distance(scan.point(beam));
    squares.add(distance * distance);
  }
  return squares.root();
}

class Segments : public MetricFamily {
 public:
  using Params = SegmentRules;
  explicit Segments(const Params& params) : params_(params) {}

  std::vector<MetricDescription> describe() const override {
    using enum Direction;
    return {
        share({"precision", "precision", "", higher_is_better, 0.005, "true / (true + false + split)"}),
        share({"recall", "recall", "", higher_is_better, 0.005, "true / (true + missed)"}),
        share({"f1", "F1", "", higher_is_better, 0.005, "harmonic mean of precision and recall"}),
        share({"precision_strict", "strict precision", "", higher_is_better, 0.005,
               "true / (true + false + split), where right lines on walls too small to be true lines count as false"}),
        share({"f1_strict", "strict F1", "", higher_is_better, 0.005, "harmonic mean of precision_strict and recall"}),
        share({"split", "split share", "", lower_is_better, 0.005,
               "share of lines that repeat a true line: split / (true + false + split)"}),
        share({"merged", "merged share", "", lower_is_better, 0.005,
               "share of lines that cover more than half of two true lines of different walls"}),
        {"sigma_offset", "offset error", "m", lower_is_better, 0.001,
         "root mean square distance of the midpoints of matched lines from their true lines"},
        {"sigma_angle", "angle error", "deg", lower_is_better, 0.05,
         "root mean square angle between matched lines and their true lines"},
        share({"overlap", "overlap", "", higher_is_better, 0.005,
               "intersection over union of the extents, mean over matched lines"}),
        {"n_true", "true lines", "", neither, 0.0, "found lines matched with a true line"},
        {"n_false", "false lines", "", neither, 0.0, "found lines that match no wall"},
        {"n_small", "lines on small walls", "", neither, 0.0,
         "right lines on walls too small to be true lines: neither true nor false"},
        {"n_missed", "missed lines", "", neither, 0.0, "true lines without a match"},
        {"n_split", "split lines", "", neither, 0.0, "further found lines of a matched true line"},
        {"n_merged", "merged lines", "", neither, 0.0,
         "found lines that cover more than half of two true lines of different walls"}};
  }

  bool applies(const MetricInput& input) const override { return has_beam_truth(input); }

  std::vector<MetricRow> evaluate(const MetricInput& input) const override {
    SCANBENCH_ASSERT(applies(input));
    const Surfaces surfaces = join_walls(input.truth->walls);
    std::int64_t n_true = 0, n_false = 0, n_small = 0, n_split = 0, n_merged = 0, n_truth = 0;
    Mean offset2, angle2, iou;
    for (std::size_t f = 0; f < input.observed.frames.size(); ++f) {
      const std::vector<LineFeature>& found = input.result.lines[f].lines;
      const auto [truths, matching] = judge_scan(input, f, surfaces, params_);
      n_truth += std::ssize(truths);
      n_merged += std::ranges::count(matching.merged, true);
      n_false += std::ranges::count(matching.outcome, Outcome::false_line);
      n_split += std::ranges::count(matching.outcome, Outcome::split);
      n_small += std::ranges::count(matching.outcome, Outcome::too_small);
      for (std::size_t k = 0; k < found.size(); ++k) {
        if (matching.outcome[k] != Outcome::true_line) continue;
        ++n_true;
        const Overlap o = overlap(found[k].segment, truths[as_index(matching.truth[k])].segment);
        offset2.add(o.offset_m * o.offset_m);
        angle2.add(degrees(o.angle_rad) * degrees(o.angle_rad));
        iou.add(o.length_m / o.union_m);
      }
    }

    const std::int64_t n_found = n_true + n_false + n_split;
    const std::int64_t n_missed = n_truth - n_true;
    Rows rows(describe());
    rows.add("precision", kAll, ratio(number(n_true), number(n_found)), n_found);
    rows.add("recall", kAll, ratio(number(n_true), number(n_truth)), n_truth);
    // 2 / (1/precision + 1/recall) in the form that is 0, not 0/0, if lines exist but none is true.
    rows.add("f1", kAll, ratio(2.0 * number(n_true), number(n_found + n_truth)), n_found + n_truth);
    const std::int64_t n_strict = n_found + n_small;
    rows.add("precision_strict", kAll, ratio(number(n_true), number(n_strict)), n_strict);
    rows.add("f1_strict", kAll, ratio(2.0 * number(n_true), number(n_strict + n_truth)), n_strict + n_truth);
    rows.add("split", kAll, ratio(number(n_split), number(n_found)), n_found);
    rows.add("merged", kAll, ratio(number(n_merged), number(n_found)), n_found);
    rows.add("sigma_offset", kAll, offset2.root(), n_true);
    rows.add("sigma_angle", kAll, angle2.root(), n_true);
    rows.add("overlap", kAll, iou);
    rows.add("n_true", kAll, number(n_true), n_found);
    rows.add("n_false", kAll, number(n_false), n_found);
    rows.add("n_small", kAll, number(n_small), n_strict);
    rows.add("n_missed", kAll, number(n_missed), n_truth);
    rows.add("n_split", kAll, number(n_split), n_found);
    rows.add("n_merged", kAll, number(n_merged), n_found);
    return rows.take();
  }

  std::vector<MetricTable> tables(const MetricInput& input) const override {
    const Surfaces surfaces = join_walls(input.truth->walls);
    MetricTable table{kScans, {"frame", "true", "false", "missed", "split", "merged", "f1", "residual_m", "small"}, {}};
    for (std::size_t f = 0; f < input.observed.frames.size(); ++f) {
      const JudgedScan judged = judge_scan(input, f, surfaces, params_);
      table.rows.push_back(
          {number(f), number(judged.count(Outcome::true_line)), number(judged.count(Outcome::false_line)),
           number(judged.missed()), number(judged.count(Outcome::split)),
           number(std::ranges::count(judged.matching.merged, true)), judged.f1(),
           residual(input.observed.scan(f), input.result.lines[f]), number(judged.count(Outcome::too_small))});
    }
    return {table};
  }

  std::vector<std::string> table_names() const override { return {kScans}; }

 private:
  Params params_;
};

SCANBENCH_REGISTER(MetricFamily, Segments,
                   {.name = "segments",
                    .summary = "found lines against true ones per scan: precision, recall, splits, merges, errors",
                    .reference = "after Hoover et al. 1996, section 4"});

}  // namespace
}  // namespace scanbench::metrics
