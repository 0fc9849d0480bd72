// efficiency: compares the errors of lines with the smallest errors that their beams allow, and the covariances that an
// extractor reports with its errors. Cramer-Rao bound of the range readings; normalised estimation error squared as in
// Bar-Shalom, Li & Kirubarajan, "Estimation with Applications to Tracking and Navigation", 2001, section 5.4.
//
// Errors for the efficiency are taken at the midpoint of the true line, because the bound holds there; errors for nees
// at the midpoint of the found line, because its covariance holds there. Matches are those of `segments` with its
// defaults. Lost returns give no information. Spurious returns count as if they were good, so their harm is part of the
// ratio. If a ratio and its whole interval are below 1, the extractor saw the truth or used the beams of two runs of a
// wall for one line.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <Eigen/LU>

#include "core/distributions.hpp"
#include "core/error.hpp"
#include "core/index.hpp"
#include "core/registry.hpp"
#include "metrics/line_bound.hpp"
#include "metrics/line_matching.hpp"
#include "metrics/rows.hpp"

namespace scanbench::metrics {
namespace {

/// The error of `found` as (offset along its normal at `point`, angle). `point` must be near both lines.
Eigen::Vector2d line_error(const PolarLine& found, const PolarLine& truth, const Vec2& point) {
  const Vec2 n = found.normal();
  const Vec2 m = truth.normal();
  const double side = n.dot(m) < 0 ? -1.0 : 1.0;  // near rho = 0 the normals can have opposite directions
  return {found.signed_distance(point) - side * truth.signed_distance(point),
          std::atan2(side * cross(m, n), side * m.dot(n))};
}

/// Squared errors and bounds of one parameter.
struct Ratio {
  Mean squared_error;
  Mean fourth_power;
  Mean bound;

  void add(double error, double variance) {
    squared_error.add(error * error);
    fourth_power.add(error * error * error * error);
    bound.add(variance);
  }
  double value() const { return squared_error.value() / bound.value(); }
  /// Half the width of the 95 % interval of the mean squared error, over the mean bound.
  double half_width() const {
    const double n = number(bound.count());
    const double mean = squared_error.value();
    const double variance = fourth_power.value() - mean * mean;
    return 1.96 * std::sqrt(std::max(variance, 0.0) / (n - 1)) / bound.value();
  }
};

constexpr const char* kMatches = "matches";  // matches.csv

/// A found line that matches a true line with enough beams.
struct MatchedLine {
  std::size_t frame = 0;
  std::size_t line = 0;
  const LineFeature& found;
  TrueLine truth;
  PolarLine true_line;
  std::optional<Eigen::Matrix2d> bound;

  Eigen::Vector2d error_at(const Vec2& point) const { return line_error(found.line, true_line, point); }
};

class Efficiency : public MetricFamily {
 public:
  struct Params {
    int min_beams = 20;
    bool matches = false;
    static auto fields() {
      return std::tuple{field("min_beams", &Params::min_beams, at_least(9), "", "fewest returns of a true line"),
                        field("matches", &Params::matches, "write matches.csv: error and bound of every matched line")};
    }
  };

  explicit Efficiency(const Params& params) : params_(params) {}

  std::vector<MetricDescription> describe() const override {
    using enum Direction;
    return {
        {"efficiency_offset", "MSE / bound, offset", "", target, 0.05,
         "mean squared error of the offset at the true line's midpoint over its mean Cramer-Rao bound; 1 is the best",
         false, 1.0},
        {"efficiency_angle", "MSE / bound, angle", "", target, 0.05,
         "mean squared error of the angle over its mean Cramer-Rao bound; 1 is the best", false, 1.0},
        {"bound_offset", "bound, offset", "m", neither, 0.0, "root of the mean bound of the offset"},
        {"bound_angle", "bound, angle", "deg", neither, 0.0, "root of the mean bound of the angle"},
        {"nees", "NEES", "", target, 0.1,
         "mean of e' C^-1 e over lines with a covariance C; honest covariances give 2, overconfident ones more; "
         "ci: the band that contains it with probability 95 % if they are honest",
         false, 2.0}};
  }

  bool applies(const MetricInput& input) const override { return has_beam_truth(input); }

  std::vector<MetricRow> evaluate(const MetricInput& input) const override {
    SCANBENCH_ASSERT(applies(input));
    Ratio offset, angle;
    Mean nees;
    for_each_match(input, [&](const MatchedLine& match) {
      if (match.bound) {
        const Eigen::Vector2d e = match.error_at(match.truth.segment.midpoint());
        offset.add(e[0], (*match.bound)(0, 0));
        angle.add(e[1], (*match.bound)(1, 1));
      }
      if (!match.found.covariance) return;
      const Eigen::Matrix2d& c = *match.found.covariance;
      if (!(c(0, 0) > 0 && c.determinant() > 0)) return;
      const Eigen::Vector2d e = match.error_at(match.found.segment.midpoint());
      nees.add(e.dot(c.inverse() * e));
    });

    Rows rows(describe());
    for (const auto& [metric, r] : {std::pair("efficiency_offset", &offset), std::pair("efficiency_angle", &angle)}) {
      MetricRow& row = rows.add(metric, kAll, r->value(), r->bound.count());
      if (row.count < 2) continue;
      row.ci_low = r->value() - r->half_width();
      row.ci_high = r->value() + r->half_width();
    }
    rows.add("bound_offset", kAll, offset.bound.root(), offset.bound.count());
    rows.add("bound_angle", kAll, degrees(angle.bound.root()), angle.bound.count());
    MetricRow& row = rows.add("nees", kAll, nees);
    if (row.count > 0) {
      const double n = number(row.count);
      row.ci_low = chi_square_quantile(0.025, 2.0 * static_cast<double>(row.count)) / n;
      row.ci_high = chi_square_quantile(0.975, 2.0 * static_cast<double>(row.count)) / n;
    }
    return rows.take();
  }

  std::vector<MetricTable> tables(const MetricInput& input) const override {
    if (!params_.matches) return {};
    MetricTable table{kMatches,
                      {"frame", "line", "first_beam", "last_beam", "beams", "range_m", "length_m", "offset_m",
                       "angle_rad", "bound_offset_m", "bound_angle_rad"},
                      {}};
    for_each_match(input, [&](const MatchedLine& match) {
      const TrueLine& t = match.truth;
      const Vec2 middle = t.segment.midpoint();
      const Eigen::Vector2d e = match.error_at(middle);
      const auto sigma = [&](int i) { return match.bound ? std::sqrt((*match.bound)(i, i)) : kUndefined; };
      table.rows.push_back({number(match.frame), number(match.line), number(t.first_beam), number(t.last_beam),
                            number(t.beams), middle.norm(), t.segment.length(), e[0], e[1], sigma(0), sigma(1)});
    });
    return {table};
  }

  std::vector<std::string> table_names() const override { return {kMatches}; }

 private:
  template <class Visit>
  void for_each_match(const MetricInput& input, Visit visit) const {
    const Surfaces surfaces = join_walls(input.truth->walls);
    for (std::size_t f = 0; f < input.observed.frames.size(); ++f) {
      const Scan scan = input.observed.scan(f);
      const std::vector<TrueLine> truths = true_lines(input, f, surfaces, TrueLineRule{});
      const std::vector<LineFeature>& found = input.result.lines[f].lines;
      const LineMatching matching = match_lines(found, truths, MatchRule{});
      for (std::size_t k = 0; k < found.size(); ++k) {
        if (matching.outcome[k] != Outcome::true_line) continue;
        const TrueLine& t = truths[as_index(matching.truth[k])];
        if (t.beams < params_.min_beams) continue;
        visit(MatchedLine{f, k, found[k], t, line_through(t.segment.a, t.segment.b), line_bound(scan, t)});
      }
    }
  }

  Params params_;
};

SCANBENCH_REGISTER(
    MetricFamily, Efficiency,
    {.name = "efficiency",
     .summary = "errors of lines against the Cramer-Rao bound of their beams, and whether their covariances are honest",
     .reference = "Cramer-Rao inequality; Bar-Shalom et al. 2001, section 5.4"});

}  // namespace
}  // namespace scanbench::metrics
