// Optimal line extraction: the cut of a scan into lines that describes it in the fewest bits under the sensor's own
// noise model, each line estimated by maximum likelihood in the coordinates of the beams. Ours; derivation, exactness
// and results in docs/algorithms/optimal.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "algorithms/extract/groups.hpp"
#include "algorithms/extract/optimal_line.hpp"
#include "algorithms/extract/optimal_segmentation.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench::extract {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const double kRootTwoPi = std::sqrt(kTwoPi);

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

// Of real sensors none always answers; with this, two missing beams do not end a wall, three do.
constexpr double kLeastDropout = 0.01;

// Range around reading i without the noise of one reading and without a spurious neighbour: median of five.
double smoothed(std::span<const double> ranges, std::size_t i) {
  const std::size_t n = ranges.size();
  if (n < 5) return ranges[i];
  const std::size_t begin = std::min(i < 2 ? 0 : i - 2, n - 5);
  std::array<double, 5> w;
  std::copy_n(ranges.begin() + static_cast<std::ptrdiff_t>(begin), 5, w.begin());
  std::nth_element(w.begin(), w.begin() + 2, w.end());
  return w[2];
}

struct Line {
  PointRun run;
  std::optional<BeamLine> fit;
};

// One scan on its way: the returns that take part, and what is known about the wall behind each.
class Extraction {
 public:
  Extraction(const Scan& scan, const SensorNoise& noise, int max_lines)
      : scan_(scan), noise_(noise), max_lines_(max_lines), points_(without_spurious(valid_points(scan))) {}

  ScanLines run(SupportRules rules, Trace& trace) {
    if (points_.size() < 2) return lines_of_runs(scan_, points_, {}, Fit::tls, rules);
    trace.stage("segment");
    segment();
    trace.stage("fit");
    // Bearing noise counts as much as the wall is oblique, which is known now.
    if (noise_.bearing_sigma_rad > 0) {
      fit();
      know_walls();
      segment();
    }
    fit();
    place_corners();
    trace.scalar("optimal_description_nats", cost_);
    return result(rules);
  }

 private:
  // Leaves out single and paired readings far in front of their neighbours, if the sensor gives spurious returns: to a
  // line they say nothing, and it goes on behind them.
  ScanPoints without_spurious(ScanPoints in) {
    for (const Vec2& p : in.points) ranges_.push_back(p.norm());
    if (!(noise_.spurious_probability > 0) || in.size() < 5) return in;
    ScanPoints kept;
    std::vector<double> kept_ranges;
    for (std::size_t i = 0; i < in.size(); ++i) {
      const double around = smoothed(ranges_, i);
      const double sigma = reading_sigma(noise_, around, 0.0);
      // Shorter as a draw from spurious returns, uniform up to the wall, than as an error of the reading.
      const double nats = std::log(1.0 / noise_.spurious_probability) + std::log(around / (sigma * kRootTwoPi));
      if (around - ranges_[i] > sigma * std::sqrt(2.0 * std::max(nats, 2.0))) continue;
      kept.beams.push_back(in.beams[i]);
      kept.points.push_back(in.points[i]);
      kept_ranges.push_back(ranges_[i]);
    }
    ranges_ = std::move(kept_ranges);
    return kept;
  }

  // Code length of one line going on from point i-1 to point i across beams that did not answer.
  double gap_cost(std::size_t i) const {
    int missing = 0;
    for (int b = points_.beams[i - 1] + 1; b < points_.beams[i]; ++b) missing += !scan_.valid(b);
    if (missing == 0) return 0.0;
    const Vec2 chord = points_.points[i] - points_.points[i - 1];
    const Vec2 d = scan_.sensor.geometry.direction(points_.beams[i]);
    const double cos_incidence = std::fabs(cross(chord, d)) / std::max(chord.norm(), 1e-12);
    const double oblique = 1.0 - std::min(cos_incidence, 1.0);
    const double p = std::clamp(noise_.dropout_probability + noise_.dropout_grazing * oblique * oblique, kLeastDropout,
                                1.0 - kLeastDropout);
    const double nats = -missing * std::log(p);
    // An opening, described by the places where it begins and ends, would be the shorter story.
    return nats > 2.0 * place_cost() ? kInfinity : nats;
  }

  // Code length of a place in the scan.
  double place_cost() const { return std::log(static_cast<double>(points_.size())); }

  void segment() {
    const std::size_t n = points_.size();
    std::vector<SegmentationPoint> in(n);
    const double span = std::max(*std::max_element(ranges_.begin(), ranges_.end()), 1.0);
    for (std::size_t i = 0; i < n; ++i) {
      const bool known = !walls_.empty() && walls_[i].range > 0;
      const double r = known ? walls_[i].range : smoothed(ranges_, i);
      const double sigma = reading_sigma(noise_, r, known ? walls_[i].slope : 0.0);
      SegmentationPoint& p = in[i];
      p.direction = scan_.sensor.geometry.direction(points_.beams[i]);
      p.inverse_range = 1.0 / ranges_[i];
      p.weight = ranges_[i] * r * r * r / (sigma * sigma);
      p.line_cost = std::log(sigma * kRootTwoPi);
      p.clutter_cost = std::log(2.0 * span);
      p.gap_cost = i > 0 ? gap_cost(i) : 0.0;
    }
    // The places where a line begins and ends; its two parameters are LineCost's log(points), half a log each.
    const LineCost line_cost{2.0 * place_cost()};
    const Segmentation best =
        max_lines_ > 0 ? optimal_segmentation_at_most(in, max_lines_) : optimal_segmentation(in, line_cost);
    cost_ = best.cost;
    lines_.clear();
    for (const PointRun& run : best.lines)
      if (run.size() >= 3) lines_.push_back({run, {}});
  }

  std::optional<BeamLine> fit(const PointRun& run, const std::optional<Vec2>& start = {}) {
    readings_.clear();
    for (int i = run.first; i <= run.last; ++i)
      readings_.push_back({scan_.sensor.geometry.direction(points_.beams[at(i)]), ranges_[at(i)]});
    return fit_beam_line(readings_, noise_, start);
  }

  void fit() {
    for (Line& line : lines_) line.fit = fit(line.run);
  }

  void know_walls() {
    walls_.assign(points_.size(), {});
    for (const Line& line : lines_) {
      if (!line.fit) continue;
      for (int i = line.run.first; i <= line.run.last; ++i) {
        const Vec2 d = scan_.sensor.geometry.direction(points_.beams[at(i)]);
        const double r = line.fit->range(d);
        walls_[at(i)] = {r, r * r * cross(line.fit->theta, d)};
      }
    }
  }

  double squared_error(const BeamLine& line, int i) const {
    const Vec2 d = scan_.sensor.geometry.direction(points_.beams[at(i)]);
    const double u = line.theta.dot(d);
    if (!(u > 0)) return kInfinity;
    const double r = 1.0 / u;
    const double e = (ranges_[at(i)] - r) / reading_sigma(noise_, r, r * r * cross(line.theta, d));
    return e * e;
  }

  // Where two walls meet, the corner says which beam sees which wall. The cut with the least misfit takes the readings
  // that happen to suit each line, and so bends both towards them; the corner does not look at the readings. It is
  // taken where it costs less than to state the place of the cut.
  void place_corners() {
    for (int pass = 0; pass < 5; ++pass) {
      bool moved = false;
      for (std::size_t k = 0; k + 1 < lines_.size(); ++k) moved = place_corner(lines_[k], lines_[k + 1]) || moved;
      if (!moved) break;
    }
  }

  bool place_corner(Line& a, Line& b) {
    if (a.run.last + 1 != b.run.first || !a.fit || !b.fit) return false;
    const auto a_is_nearer = [&](int i) {
      return (a.fit->theta - b.fit->theta).dot(scan_.sensor.geometry.direction(points_.beams[at(i)])) > 0;
    };
    const bool before = a_is_nearer(a.run.first);
    if (a_is_nearer(b.run.last) == before) return false;  // a step, not a corner
    int cut = b.run.first;                                // first point of b
    while (cut <= b.run.last && a_is_nearer(cut) == before) ++cut;
    while (cut > a.run.first && a_is_nearer(cut - 1) != before) --cut;
    if (cut == b.run.first || cut - a.run.first < 3 || b.run.last - cut < 2) return false;
    double loss = 0.0;
    for (int i = b.run.first; i < cut; ++i) loss += squared_error(*a.fit, i) - squared_error(*b.fit, i);
    for (int i = cut; i < b.run.first; ++i) loss += squared_error(*b.fit, i) - squared_error(*a.fit, i);
    if (!(0.5 * loss < place_cost())) return false;
    a.run.last = cut - 1;
    b.run.first = cut;
    a.fit = fit(a.run, a.fit->theta);
    b.fit = fit(b.run, b.fit->theta);
    return true;
  }

  ScanLines result(SupportRules rules) {
    std::vector<PointRun> runs;
    std::vector<LineFit> fits;
    std::vector<int> line_of_first_beam(at(scan_.beams()), -1);
    for (std::size_t k = 0; k < lines_.size(); ++k) {
      const PointRun& run = lines_[k].run;
      const std::span support = std::span(points_.points).subspan(at(run.first), at(run.size()));
      LineFit line = fit_group(support, Fit::tls);
      if (const auto& beam_line = lines_[k].fit) {
        line.normal = beam_line->normal();
        line.offset = beam_line->rho();
        line.residual_sum = 0.0;
        line.degenerate = false;
        for (const Vec2& p : support) line.residual_sum += std::pow(line.distance(p), 2);
      }
      runs.push_back(run);
      fits.push_back(line);
      line_of_first_beam[at(points_.beams[at(run.first)])] = static_cast<int>(k);
    }
    ScanLines out = lines_of_runs(scan_, points_, runs, fits, rules);
    for (LineFeature& line : out.lines) {
      const auto& fitted = lines_[at(line_of_first_beam[at(line.first_beam)])].fit;
      if (fitted) line.covariance = line_covariance(*fitted, line.segment.midpoint());
    }
    return out;
  }

  struct Wall {
    double range = 0.0;  ///< 0: unknown
    double slope = 0.0;  ///< change of range per radian of bearing
  };

  const Scan& scan_;
  const SensorNoise& noise_;
  int max_lines_;
  std::vector<double> ranges_;  // of points_
  ScanPoints points_;
  std::vector<Wall> walls_;
  std::vector<Line> lines_;
  std::vector<BeamReading> readings_;
  double cost_ = 0.0;
};

class Optimal final : public LineExtractor {
 public:
  struct Params {
    double sigma_m = 0.0;
    int max_lines = 0;
    int min_points = 9;
    double min_length_m = 0.0;
    static auto fields() {
      return std::tuple_cat(
          std::tuple{
              field("sigma_m", &Params::sigma_m, at_least(0), "m",
                    "standard deviation of a range where the sensor's own is not to be trusted; 0: the sensor's"),
              field("max_lines", &Params::max_lines, between(0, 10000), "",
                    "the best cut into at most so many lines; 0: as many as shorten the description")},
          support_fields<Params>());
    }
  };

  explicit Optimal(const Params& p)
      : sigma_m_(p.sigma_m), max_lines_(p.max_lines), rules_{p.min_points, p.min_length_m} {}

  ScanLines extract(const Scan& scan, Trace& trace) const override {
    trace.stage("pre");
    SensorNoise noise = scan.sensor.noise;
    if (sigma_m_ > 0) {
      noise.sigma_m = sigma_m_;
      noise.sigma_relative = 0.0;
    }
    return Extraction(scan, noise, max_lines_).run(rules_, trace);
  }

 private:
  double sigma_m_;
  int max_lines_;
  SupportRules rules_;
};

const bool registered = Registry<LineExtractor>::add<Optimal>(
    {.name = "optimal",
     .summary = "shortest description under the sensor's noise model: dynamic programme and maximum likelihood",
     .reference = "docs/algorithms/optimal.md; pruning after Killick, Fearnhead & Eckley 2012"});

}  // namespace
}  // namespace scanbench::extract
