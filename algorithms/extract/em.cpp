// em: expectation maximisation over segments whose number is unknown. Computing memberships and fitting weighted least
// squares alternate. Segments are split where they do not fit, deleted where no points support them, and merged where
// one line fits both. The method follows the idea of the extended EM of Latecki & Lakaemper, "Polygonal approximation
// of laser range data based on perceptual grouping and EM", ICRA 2006. The schedule and the tests below are our own.
//
// The order of the beams is used for the first segments only, so a wall across the seam of a full turn is one wall.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "algorithms/extract/parts/breakpoints.hpp"
#include "algorithms/extract/parts/chord.hpp"
#include "algorithms/extract/parts/covariance.hpp"
#include "algorithms/extract/parts/noise_scale.hpp"
#include "core/geometry/portable_math.hpp"
#include "core/index.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

using namespace extract;

constexpr std::size_t kMinPoints = 4;  // smallest number of points of a segment while EM runs
constexpr std::size_t kWindow = 8;     // number of points over which a misfit is averaged
const double kCosMergeAngle = portable::sincos(radians(5.0)).cos;

// A segment: a line and the interval of it that the points of the segment cover.
struct Component {
  LineFit line;
  PointMoments moments;  // moments of its own points
  Vec2 along{0, 1};
  double low = 0.0;
  double high = 0.0;
  std::vector<int> own;  // points with a membership above one half, in order along the line

  double distance2(const Vec2& p) const {
    const double t = along.x() * p.x() + along.y() * p.y();
    const double beyond = t < low ? low - t : t > high ? t - high : 0.0;
    const double off = line.normal.x() * p.x() + line.normal.y() * p.y() - line.offset;
    return off * off + beyond * beyond;
  }
};

/// The state at the end of a round.
struct EmRow {
  static constexpr std::string_view kName = "em";
  int round = 0;
  double sigma_m = 0.0;
  int segments = 0;
  static constexpr auto columns() {
    return std::tuple{column("round", &EmRow::round), column("sigma_m", &EmRow::sigma_m),
                      column("segments", &EmRow::segments)};
  }
};

class Em final : public LineExtractor {
 public:
  struct Params {
    double start_m = 0.2;
    double cooling = 0.7;
    double floor_m = 0.01;
    double split_gap_m = 0.3;
    double merge_gap_m = 0.2;
    int max_rounds = 50;
    int min_points = 5;
    double min_length_m = 0.1;

    static auto fields() {
      return std::tuple_cat(
          std::tuple{field("start_m", &Params::start_m, between(1e-4, 100), "m",
                           "standard deviation of a point about its segment in the first round, and tolerance of the "
                           "first segments"),
                     field("cooling", &Params::cooling, between(0.1, 0.95), "",
                           "factor by which the standard deviation decreases per round, down to the sensor's"),
                     field("floor_m", &Params::floor_m, between(1e-6, 1e3), "m",
                           "smallest standard deviation, for sensors without stated noise"),
                     field("split_gap_m", &Params::split_gap_m, above(0), "m",
                           "largest gap between the points of a segment; it is split at larger ones"),
                     field("merge_gap_m", &Params::merge_gap_m, at_least(0), "m",
                           "largest gap between collinear segments that are merged"),
                     field("max_rounds", &Params::max_rounds, between(1, 1000), "", "largest number of rounds")},
          support_fields<Params>());
    }
  };

  explicit Em(const Params& params) : params_(params) {}

  ScanLines extract(const Scan& scan, Trace& trace) const override {
    trace.stage(Stage::pre);
    const ScanPoints points = valid_points(scan);
    const std::vector<double> sigma = tolerances(scan, points, {1.0, params_.floor_m});
    trace.stage(Stage::segment);
    std::vector<Component> components = first_segments(points);
    std::vector<int> owner(points.size(), -1);
    double anneal = params_.start_m;
    for (int round = 0; round < params_.max_rounds; ++round, anneal *= params_.cooling) {
      std::vector<double> s(sigma);
      bool cold = true;
      for (double& value : s) {
        cold = cold && value >= anneal;
        value = std::max(value, anneal);
      }
      std::vector<int> before = std::move(owner);
      owner = expect_and_maximise(points.points, s, components);
      split(points.points, s, components);
      merge(sigma, components);
      owner.assign(points.size(), -1);
      for (std::size_t k = 0; k < components.size(); ++k)
        for (const int i : components[k].own) owner[as_index(i)] = static_cast<int>(k);
      trace.row(EmRow{round, anneal, static_cast<int>(components.size())});
      if (cold && owner == before) break;
    }
    trace.stage(Stage::post);
    ScanLines result = lines_of_groups(scan, points, owner, static_cast<int>(components.size()), Fit::tls,
                                       {params_.min_points, params_.min_length_m});
    add_covariances(scan, points, result);
    return result;
  }

 private:
  static Component from_points(std::span<const Vec2> points, std::vector<int> own) {
    Component c;
    c.moments = moments_of(points, own);
    c.own = std::move(own);
    set_line(points, fit_line(c.moments), c);
    return c;
  }

  static void set_line(std::span<const Vec2> points, const LineFit& line, Component& c) {
    c.line = line;
    c.along = perpendicular(line.normal);
    const double ux = c.along.x(), uy = c.along.y();
    const auto place = [&](int i) {
      const Vec2& p = points[as_index(i)];
      return ux * p.x() + uy * p.y();
    };
    std::stable_sort(c.own.begin(), c.own.end(), [&](int a, int b) { return place(a) < place(b); });
    if (c.own.empty()) return;
    c.low = place(c.own.front());
    c.high = place(c.own.back());
  }

  std::vector<Component> first_segments(const ScanPoints& points) const {
    std::vector<Component> components;
    // Splitting chords at start_m also separates surfaces at range jumps. Breakpoints are not used, because in a dense
    // scan they would make a segment of every outlier.
    std::vector<PointRun> pending = runs_between_gaps(points, {});
    while (!pending.empty()) {
      const PointRun run = pending.back();
      pending.pop_back();
      if (run.size() >= 3) {
        const Farthest far = farthest_from_chord(points.points, run);
        if (far.exceeds(params_.start_m)) {
          pending.push_back({far.index + 1, run.last});
          pending.push_back({run.first, far.index});
          continue;
        }
      }
      if (run.size() < static_cast<int>(kMinPoints)) continue;
      std::vector<int> own(as_index(run.size()));
      std::iota(own.begin(), own.end(), run.first);
      components.push_back(from_points(points.points, std::move(own)));
    }
    std::ranges::sort(components, {}, [](const Component& c) { return *std::ranges::min_element(c.own); });
    return components;
  }

  // E step: p(j | i) is proportional to exp(-d_ij^2 / 2 s_i^2). An outlier class has the density at 3 s_i.
  // M step: weighted least squares. A segment's interval is that of its own points, those with p > 1/2.
  static std::vector<int> expect_and_maximise(std::span<const Vec2> points, std::span<const double> s,
                                              std::vector<Component>& components) {
    static const double outlier = portable::exp(-4.5);
    constexpr double kNegligible = 30.0;  // exp(-15), against exp(-4.5)
    std::vector<PointMoments> weighted(components.size());
    std::vector<int> owner(points.size(), -1);
    std::vector<std::pair<std::size_t, double>> near;
    for (Component& c : components) c.own.clear();
    for (std::size_t i = 0; i < points.size(); ++i) {
      near.clear();
      double sum = outlier;
      for (std::size_t k = 0; k < components.size(); ++k) {
        const double u = components[k].distance2(points[i]) / (s[i] * s[i]);
        if (!(u < kNegligible)) continue;
        near.emplace_back(k, portable::exp(-0.5 * u));
        sum += near.back().second;
      }
      for (const auto& [k, density] : near) {
        const double p = density / sum;
        weighted[k].add(points[i], p);
        if (p > 0.5) {
          owner[i] = static_cast<int>(k);
          components[k].own.push_back(static_cast<int>(i));
        }
      }
    }
    for (std::size_t k = 0; k < components.size(); ++k) {
      Component& c = components[k];
      c.moments = moments_of(points, c.own);
      const LineFit line = fit_line(weighted[k]);
      set_line(points, line.degenerate ? c.line : line, c);
    }
    return owner;
  }

  // Splits segments at gaps and where they misfit; deletes those with too few points.
  void split(std::span<const Vec2> points, std::span<const double> s, std::vector<Component>& components) const {
    std::vector<Component> kept;
    std::vector<Component> pending(std::make_move_iterator(components.rbegin()),
                                   std::make_move_iterator(components.rend()));
    while (!pending.empty()) {
      Component c = std::move(pending.back());
      pending.pop_back();
      if (c.own.size() < kMinPoints) continue;
      const std::size_t split_at = split_place(points, s, c);
      if (split_at == 0) {
        kept.push_back(std::move(c));
        continue;
      }
      const auto middle = c.own.begin() + static_cast<std::ptrdiff_t>(split_at);
      pending.push_back(from_points(points, {middle, c.own.end()}));
      pending.push_back(from_points(points, {c.own.begin(), middle}));
    }
    components = std::move(kept);
  }

  // The number of points before the split; 0: no split is needed.
  std::size_t split_place(std::span<const Vec2> points, std::span<const double> s, const Component& c) const {
    const auto point = [&](std::size_t k) -> const Vec2& { return points[as_index(c.own[k])]; };
    for (std::size_t k = 1; k < c.own.size(); ++k)
      if (c.along.dot(point(k) - point(k - 1)) > params_.split_gap_m) return k;
    if (c.own.size() < 2 * kMinPoints) return 0;
    double sum = 0.0;  // sum of |residual| / s over the kWindow points up to k
    const auto misfit = [&](std::size_t k) {
      return std::fabs(c.line.normal.dot(point(k)) - c.line.offset) / s[as_index(c.own[k])];
    };
    bool bad = false;
    for (std::size_t k = 0; k < c.own.size() && !bad; ++k) {
      sum += misfit(k);
      if (k >= kWindow) sum -= misfit(k - kWindow);
      bad = k + 1 >= kWindow && sum > 2.0 * static_cast<double>(kWindow);
    }
    if (!bad) return 0;
    std::vector<Vec2> sorted;
    for (std::size_t k = 0; k < c.own.size(); ++k) sorted.push_back(point(k));
    return as_index(farthest_from_chord(sorted, {0, static_cast<int>(sorted.size()) - 1}).index);
  }

  // Merges pairs of nearly the same direction that overlap or have a small gap, if one line fits both within the
  // sensor's noise.
  void merge(std::span<const double> sigma, std::vector<Component>& components) const {
    std::vector<bool> gone(components.size(), false);
    for (std::size_t a = 0; a < components.size(); ++a) {
      if (gone[a]) continue;
      for (std::size_t b = a + 1; b < components.size(); ++b) {
        if (gone[b] || !mergeable(sigma, components[a], components[b])) continue;
        join(components[a], components[b]);
        gone[b] = true;
      }
    }
    std::size_t kept = 0;
    for (std::size_t k = 0; k < components.size(); ++k) {
      if (gone[k]) continue;
      if (kept != k) components[kept] = std::move(components[k]);
      ++kept;
    }
    components.resize(kept);
  }

  bool mergeable(std::span<const double> sigma, const Component& a, const Component& b) const {
    if (std::fabs(a.along.dot(b.along)) < kCosMergeAngle) return false;
    const auto [low, high] = interval_on(a, b);
    if (std::max(low - a.high, a.low - high) > params_.merge_gap_m) return false;
    PointMoments both = a.moments;
    both.add(b.moments);
    double s = 0.0;
    for (const Component* c : {&a, &b})
      for (const int i : c->own) s += sigma[as_index(i)] / both.weight();
    return fit_line(both).rms() <= 1.2 * s;
  }

  // The interval of b on the line of a.
  static std::pair<double, double> interval_on(const Component& a, const Component& b) {
    const double u = a.along.dot(b.line.offset * b.line.normal + b.low * b.along);
    const double v = a.along.dot(b.line.offset * b.line.normal + b.high * b.along);
    return {std::min(u, v), std::max(u, v)};
  }

  static void join(Component& a, Component& b) {
    a.moments.add(b.moments);
    const LineFit line = fit_line(a.moments);
    // The interval covers both; the next round shortens it to the points.
    Component united = a;
    united.line = line;
    united.along = perpendicular(line.normal);
    const auto [a_low, a_high] = interval_on(united, a);
    const auto [b_low, b_high] = interval_on(united, b);
    united.low = std::min(a_low, b_low);
    united.high = std::max(a_high, b_high);
    united.own.insert(united.own.end(), b.own.begin(), b.own.end());
    a = std::move(united);
  }

  Params params_;
};

SCANBENCH_REGISTER(
    LineExtractor, Em,
    {.name = "em",
     .summary = "expectation maximisation over segments with split, deletion and merge; their number need not be known",
     .reference = "In the spirit of Latecki & Lakaemper 2006, ICRA, extended EM"});

}  // namespace
}  // namespace scanbench
