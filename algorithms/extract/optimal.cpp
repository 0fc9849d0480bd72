// optimal: finds the division of a scan into lines and clutter that has the shortest description under the noise model
// of the sensor. Each line is estimated by maximum likelihood in the coordinates of the beams. Our own algorithm;
// derivation, exactness and results are in docs/algorithms/optimal.md.
#include <algorithm>
#include <cmath>

#include "algorithms/extract/optimal/hidden_break.hpp"
#include "algorithms/extract/optimal/line_ends.hpp"
#include "algorithms/extract/optimal/segmentation.hpp"
#include "algorithms/extract/parts/beam_line.hpp"
#include "algorithms/extract/parts/groups.hpp"
#include "algorithms/extract/parts/scan_model.hpp"
#include "core/index.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"
#include "core/special_values.hpp"

namespace scanbench::extract {
namespace {

/// The length of the description that was found.
struct OptimalDescriptionRow {
  static constexpr std::string_view kName = "optimal_description_nats";
  double length_nats = 0.0;
  static constexpr auto columns() { return std::tuple{column("length_nats", &OptimalDescriptionRow::length_nats)}; }
};

// The share of lines that are two walls nearly on one line, before the scan is seen, and the number of lines that this
// share counts for.
constexpr double kBreakShare = 0.1;
constexpr double kBreakLines = 1.0;
constexpr int kBreakRounds = 10;   // rounds of the estimate of that share
constexpr int kBreakReadings = 4;  // fewest readings of each of the two walls
constexpr int kMinReadings = 3;    // fewest readings of a line; two readings are always on one line

struct Line {
  PointRun run;
  std::optional<BeamLine> fit;
  std::optional<BeamLine> unaveraged;  // of greatest likelihood for this run, as far as it is known
};

// The extraction of one scan: its returns, the lines found so far, and the walls that they imply for each return.
class OptimalExtraction {
 public:
  OptimalExtraction(const Scan& scan, const SensorNoise& noise, int max_lines)
      : scan_(scan), noise_(noise), max_lines_(max_lines), model_(scan, noise) {
    readings_.reserve(model_.size());
    for (std::size_t i = 0; i < model_.size(); ++i) readings_.push_back({model_.direction(i), model_.ranges()[i]});
  }

  ScanLines run(SupportRules rules, Trace& trace) {
    if (model_.size() < 2) return lines_of_runs(scan_, model_.points(), {}, Fit::tls, rules);
    trace.stage(Stage::segment);
    segment();
    trace.stage(Stage::fit);
    // The effect of bearing noise depends on the obliqueness of the walls, which is known only after the first pass.
    if (noise_.bearing_rad2 > 0) {
      fit();
      set_walls_from_lines();
      segment();
    }
    fit();
    place_corners();
    average_over_ends();
    average_over_breaks();
    trace.row(OptimalDescriptionRow{cost_});
    return result(rules);
  }

 private:
  void segment() {
    const std::vector<SegmentationPoint> in = model_.segmentation_points(walls_);
    // The code of a line contains the place where it ends and half a place for where it begins, because a line most
    // often begins where the line before it ends. LineCost adds half a log(points) for each of the two parameters of
    // the line.
    const LineCost line_cost{1.5 * model_.place_cost()};
    const Segmentation best =
        max_lines_ > 0 ? optimal_segmentation_at_most(in, max_lines_) : optimal_segmentation(in, line_cost);
    cost_ = best.cost;
    lines_.clear();
    for (const PointRun& run : best.lines)
      if (run.size() >= kMinReadings) lines_.push_back({run, {}, {}});
  }

  std::span<const BeamReading> readings(const PointRun& run) const {
    return std::span(readings_).subspan(as_index(run.first), as_index(run.size()));
  }

  std::optional<BeamLine> fit(const PointRun& run, const std::optional<Vec2>& start = {}) const {
    return fit_beam_line(readings(run), noise_, start);
  }

  void fit() {
    for (Line& line : lines_) line.fit = fit(line.run);
  }

  void set_walls_from_lines() {
    walls_.assign(model_.size(), {});
    for (const Line& line : lines_) {
      if (!line.fit) continue;
      for (int i = line.run.first; i <= line.run.last; ++i) {
        const Vec2 d = model_.direction(as_index(i));
        const double r = line.fit->range(d);
        walls_[as_index(i)] = {r, r * r * cross(line.fit->theta, d)};
      }
    }
  }

  double squared_error(const BeamLine& line, int i) const {
    const Vec2 d = model_.direction(as_index(i));
    const double u = line.theta.dot(d);
    if (!(u > 0)) return kInf;
    const double r = 1.0 / u;
    const double e = model_.ranges()[as_index(i)] - r;
    return e * e / noise_.variance(r, r * r * cross(line.theta, d));
  }

  // Where two walls meet, the intersection of their lines determines which beam sees which wall. The cut with the least
  // misfit assigns each reading to the line that it happens to fit, which biases both lines. The intersection does not
  // depend on single readings. It replaces the cut if this costs less than the code of the cut's place.
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
      return (a.fit->theta - b.fit->theta).dot(model_.direction(as_index(i))) > 0;
    };
    const bool before = a_is_nearer(a.run.first);
    if (a_is_nearer(b.run.last) == before) return false;  // the lines end at a step, not at a corner
    int cut = b.run.first;                                // index of the first point of b
    while (cut <= b.run.last && a_is_nearer(cut) == before) ++cut;
    while (cut > a.run.first && a_is_nearer(cut - 1) != before) --cut;
    if (cut == b.run.first || cut - a.run.first < kMinReadings || b.run.last - cut + 1 < kMinReadings) return false;
    double loss = 0.0;
    for (int i = b.run.first; i < cut; ++i) loss += squared_error(*a.fit, i) - squared_error(*b.fit, i);
    for (int i = cut; i < b.run.first; ++i) loss += squared_error(*b.fit, i) - squared_error(*a.fit, i);
    if (!(0.5 * loss < model_.place_cost())) return false;
    a.run.last = cut - 1;
    b.run.first = cut;
    a.fit = fit(a.run, a.fit->theta);
    b.fit = fit(b.run, b.fit->theta);
    return true;
  }

  FittedReadings fitted(const Line& line) const { return {*line.fit, readings(line.run)}; }

  // Does nothing separate the last reading of line k from the first of line k + 1, and are both lines fitted?
  bool is_junction(std::size_t k) const {
    if (k + 1 >= lines_.size() || !lines_[k].fit || !lines_[k + 1].fit) return false;
    const int last = lines_[k].run.last;
    return lines_[k + 1].run.first == last + 1 && are_neighbours(last, last + 1);
  }

  bool are_neighbours(int i, int j) const {
    return std::abs(model_.points().beams[as_index(j)] - model_.points().beams[as_index(i)]) <= 1;
  }

  // An end that no line follows. It is certain across missing beams, and next to a line that could not be fitted.
  UncertainEnd open_end(std::size_t k, End end) const {
    const PointRun& run = lines_[k].run;
    const int own = end == End::last ? run.last : run.first;
    const int next = own + (end == End::last ? 1 : -1);
    if (next < 0 || next >= static_cast<int>(model_.size()) || !are_neighbours(own, next)) return {};
    const std::size_t other = end == End::last ? k + 1 : k - 1;
    if (other < lines_.size() && lines_[other].run.first <= next && next <= lines_[other].run.last) return {};
    return end_towards_range(fitted(lines_[k]), noise_, end, model_.ranges()[as_index(next)], kMinReadings);
  }

  // Averages every line over the hypotheses about which readings at its ends belong to it. The probability of a side is
  // estimated from the scan. The prior counts as one side in two junctions; the estimate is the mean over it and the
  // junctions of the scan.
  void average_over_ends() {
    std::vector<std::array<UncertainEnd, 2>> open(lines_.size());
    for (std::size_t k = 0; k < lines_.size(); ++k) {
      if (!lines_[k].fit) continue;
      if (k == 0 || !is_junction(k - 1)) open[k][0] = open_end(k, End::first);
      if (is_junction(k)) {
        const auto ends = ends_at_junction(fitted(lines_[k]), fitted(lines_[k + 1]), noise_, kMinReadings);
        open[k][1] = ends[0];
        open[k + 1][0] = ends[1];
      } else {
        open[k][1] = open_end(k, End::last);
      }
    }
    std::vector<std::optional<UncertainEnds>> ends(lines_.size());
    double sides = 1.0, junctions = 2.0;
    const double prior = sides / junctions;
    for (std::size_t k = 0; k < lines_.size(); ++k) {
      if (!lines_[k].fit) continue;
      ends[k].emplace(*lines_[k].fit, open[k]);
      const std::array is_joined = {k > 0 && is_junction(k - 1), is_junction(k)};
      if (!is_joined[0] && !is_joined[1]) continue;
      const UncertainLine estimate = ends[k]->average(prior);
      for (std::size_t end = 0; end < 2; ++end) {
        if (!is_joined[end]) continue;
        sides += 0.5 * estimate.side[end];  // each junction is counted from both lines
        junctions += 0.5;
      }
    }
    for (std::size_t k = 0; k < lines_.size(); ++k) {
      if (!ends[k]) continue;
      const UncertainLine line = ends[k]->average(sides / junctions);
      if (line.foreign == std::array{0, 0}) lines_[k].unaveraged = lines_[k].fit;
      lines_[k].fit = line.line;
      lines_[k].run.first += line.foreign[0];
      lines_[k].run.last -= line.foreign[1];
    }
  }

  // Averages every line over whether it is two walls nearly on one line. As with sides, the probability of that is
  // estimated from the scan: a scan of a plain room shows no breaks, a scan of facets shows many.
  void average_over_breaks() {
    std::vector<std::optional<HiddenBreak>> breaks(lines_.size());
    int possible = 0;
    for (std::size_t k = 0; k < lines_.size(); ++k) {
      if (!lines_[k].fit) continue;
      const std::optional<BeamLine> whole =
          lines_[k].unaveraged ? lines_[k].unaveraged : fit(lines_[k].run, lines_[k].fit->theta);
      if (!whole) continue;
      breaks[k].emplace(*whole, readings(lines_[k].run), noise_, kBreakReadings);
      possible += breaks[k]->possible() ? 1 : 0;
    }
    double share = kBreakShare;
    for (int round = 0; round < kBreakRounds; ++round) {
      double broken = kBreakShare * kBreakLines;
      for (const auto& b : breaks)
        if (b && b->possible()) broken += b->probability(share);
      share = broken / (kBreakLines + possible);
    }
    for (std::size_t k = 0; k < lines_.size(); ++k)
      if (breaks[k]) lines_[k].fit = breaks[k]->average(*lines_[k].fit, share);
  }

  ScanLines result(SupportRules rules) {
    std::vector<PointRun> runs;
    std::vector<LineFit> fits;
    std::vector<int> line_of_first_beam(as_index(scan_.beams()), -1);
    for (std::size_t k = 0; k < lines_.size(); ++k) {
      const PointRun& run = lines_[k].run;
      const std::span support = std::span(model_.points().points).subspan(as_index(run.first), as_index(run.size()));
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
      line_of_first_beam[as_index(model_.points().beams[as_index(run.first)])] = static_cast<int>(k);
    }
    ScanLines out = lines_of_runs(scan_, model_.points(), runs, fits, rules);
    for (LineFeature& line : out.lines) {
      const auto& fitted = lines_[as_index(line_of_first_beam[as_index(line.first_beam)])].fit;
      if (fitted) line.covariance = line_covariance(*fitted, line.segment.midpoint());
    }
    return out;
  }

  const Scan& scan_;
  ReadingNoise noise_;
  int max_lines_;
  ScanModel model_;
  std::vector<KnownWall> walls_;
  std::vector<Line> lines_;
  std::vector<BeamReading> readings_;  // readings of all returns
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
          std::tuple{field("sigma_m", &Params::sigma_m, at_least(0), "m",
                           "standard deviation of a range, in place of the sensor's own; 0 uses the sensor's"),
                     field("max_lines", &Params::max_lines, between(0, 10000), "",
                           "largest number of lines; 0: as many as shorten the description")},
          support_fields<Params>());
    }
  };

  explicit Optimal(const Params& p)
      : sigma_m_(p.sigma_m), max_lines_(p.max_lines), rules_{p.min_points, p.min_length_m} {}

  ScanLines extract(const Scan& scan, Trace& trace) const override {
    trace.stage(Stage::pre);
    SensorNoise noise = scan.sensor.noise;
    if (sigma_m_ > 0) {
      noise.sigma_m = sigma_m_;
      noise.sigma_relative = 0.0;
    }
    return OptimalExtraction(scan, noise, max_lines_).run(rules_, trace);
  }

 private:
  double sigma_m_;
  int max_lines_;
  SupportRules rules_;
};

SCANBENCH_REGISTER(
    LineExtractor, Optimal,
    {.name = "optimal",
     .summary =
         "shortest description of the scan under the sensor's noise model: dynamic programme and maximum likelihood",
     .reference = "docs/algorithms/optimal.md; pruning after Killick, Fearnhead & Eckley 2012"});

}  // namespace
}  // namespace scanbench::extract
