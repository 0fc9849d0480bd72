// closure: whether covariances of matched poses explain by how much three matches of three scans disagree. It needs no
// truth, so recorded scans will do.
//
// Scan k + 2 is matched with scan k + 1, that one with scan k, and scan k + 2 with scan k. The two ways differ by the
// closure error. Over the sum of the three stated covariances it is chi-square with three degrees of freedom if they
// are honest and the errors independent. They are not quite: each scan takes part in two matches, so that most of its
// noise cancels, and so does any error that the matches share with the odometry that they start from. Small closures
// therefore prove nothing; large ones are errors that no covariance states, moving bodies, glass, wrong pairs.
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "core/distributions.hpp"
#include "core/error.hpp"
#include "core/geometry/angles.hpp"
#include "core/median.hpp"
#include "core/registry.hpp"
#include "metrics/pose_closure.hpp"
#include "metrics/rows.hpp"

namespace scanbench::metrics {
namespace {

constexpr const char* kClosureTable = "closures";  // closures.csv
constexpr double kRare = 0.001;                    // of honest closures are above the limit, 16.27

class ClosureFamily : public MetricFamily {
 public:
  struct Params {
    int triples = 1000;
    bool table = false;
    static auto fields() {
      return std::tuple{field("triples", &Params::triples, between(1, 1e6), "",
                              "triples of scans at most, spread evenly over the scans; each costs one more match"),
                        field("table", &Params::table, "write closures.csv: the closure of every triple that counts")};
    }
  };
  explicit ClosureFamily(const Params& params) : params_(params) {}

  std::vector<MetricDescription> describe() const override {
    using enum Direction;
    return {
        share({"closure_over", "closures above 99.9 %", "", lower_is_better, 0.01,
               "share of the closures above the 99.9 % quantile of chi-square, 16.27: errors that the stated "
               "covariances do not explain. A matcher that repeats the odometry has none"}),
        {"closure_mean", "mean closure", "", neither, 0.0,
         "mean of c' S^-1 c, c the difference of the pose of scan k + 2 in scan k by two matches over scan k + 1 and "
         "by one match, S the sum of the three covariances; at most 3 if they are honest: less, because matches share "
         "scans. With an open motion, the value of three degrees of freedom that is as rare"},
        {"closure_median", "median closure", "", neither, 0.0,
         "median of c' S^-1 c, as in closure_mean; at most 2.37 if covariances are honest"},
        {"closure_position", "closure, position", "m", neither, 0.0,
         "root mean square difference of the positions by the two ways"},
        {"closure_heading", "closure, heading", "deg", neither, 0.0,
         "root mean square difference of the headings by the two ways"},
        share({"closure_counted", "closures counted", "", neither, 0.0,
               "share of the triples that count: the three matches succeed, state covariances and leave a motion in "
               "common determined"}),
        share({"closure_open", "closures with an open motion", "", neither, 0.0,
               "share of those in which a match leaves a motion open; they have fewer degrees of freedom, and are not "
               "in closure_position and closure_heading"})};
  }

  int skip_matches() const override { return params_.triples; }

  bool applies(const MetricInput& input) const override { return !input.result.skip_matches.empty(); }

  std::vector<MetricRow> evaluate(const MetricInput& input) const override {
    SCANBENCH_ASSERT(applies(input));
    const double limit = chi_square_quantile(1.0 - kRare, 3.0);
    Mean over, mean, shift, turn, open;
    std::vector<double> values;
    for_each_closure(input, [&](const FrameMatch&, const Closure& closure) {
      const double value = as_three_degrees(closure.square, closure.freedom);
      values.push_back(value);
      mean.add(value);
      over.add(value > limit ? 1.0 : 0.0);
      open.add(closure.freedom < 3 ? 1.0 : 0.0);
      if (closure.freedom < 3) return;
      shift.add(closure.error.head<2>().squaredNorm());
      turn.add(closure.error.z() * closure.error.z());
    });
    const auto all = std::ssize(input.result.skip_matches);
    Rows rows(describe());
    rows.add("closure_over", kAll, over);
    rows.add("closure_mean", kAll, mean);
    rows.add("closure_median", kAll, values.empty() ? kUndefined : median(values), std::ssize(values));
    rows.add("closure_position", kAll, shift.root(), shift.count());
    rows.add("closure_heading", kAll, degrees(turn.root()), turn.count());
    rows.add("closure_counted", kAll, ratio(number(std::ssize(values)), number(all)), all);
    rows.add("closure_open", kAll, open);
    return rows.take();
  }

  std::vector<MetricTable> tables(const MetricInput& input) const override {
    if (!params_.table) return {};
    MetricTable table{kClosureTable, {"frame", "reference", "x_m", "y_m", "yaw_rad", "square", "freedom"}, {}};
    for_each_closure(input, [&](const FrameMatch& both, const Closure& c) {
      table.rows.push_back({number(both.frame), number(both.reference), c.error.x(), c.error.y(), c.error.z(), c.square,
                            number(c.freedom)});
    });
    return {table};
  }

  std::vector<std::string> table_names() const override { return {kClosureTable}; }

 private:
  /// Calls visit(match with the last scan but one, closure) for the triples that count.
  template <class Visit>
  static void for_each_closure(const MetricInput& input, Visit visit) {
    std::map<int, const FrameMatch*> with_last;  // by frame
    for (const FrameMatch& match : input.result.matches)
      if (match.reference == match.frame - 1) with_last[match.frame] = &match;
    for (const FrameMatch& both : input.result.skip_matches) {
      const auto first = with_last.find(both.frame - 1), second = with_last.find(both.frame);
      if (both.reference != both.frame - 2 || first == with_last.end() || second == with_last.end()) continue;
      if (const auto closure = closure_of(first->second->match, second->second->match, both.match))
        visit(both, *closure);
    }
  }

  Params params_;
};

SCANBENCH_REGISTER(
    MetricFamily, ClosureFamily,
    {.name = "closure",
     .summary = "disagreement of matches over one scan and past it, against their covariances; needs no truth",
     .reference = "docs/algorithms/scan_matching.md, section 5; Bar-Shalom et al. 2001"});

}  // namespace
}  // namespace scanbench::metrics
