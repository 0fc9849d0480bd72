// Dynamic programme over the returns of a scan. docs/algorithms/optimal.md, sections 3 and 4.
#include "algorithms/extract/optimal_segmentation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace scanbench::extract {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kKnotsPerGroup = 16;
constexpr std::size_t kGroupsPerAnchor = 4;
constexpr std::size_t kKnotsPerSweep = 8;  // pruned groups are removed every so many knots

// Sums of w * (cos^2, cos sin, sin^2, cos v, sin v, v^2) over points, in the frame of an anchor.
using Sums = std::array<double, 6>;

// A frame near the points that it sums: its axis is the direction of its first point, and inverse ranges are counted
// from an arc at that point. Sums over the whole scan would lose the misfit of a few adjacent beams to cancellation.
class Anchor {
 public:
  explicit Anchor(const SegmentationPoint& p) : axis_(p.direction), inverse_range_(p.inverse_range) {}

  void add(const SegmentationPoint& p) {
    const double c = axis_.dot(p.direction);
    const double s = cross(axis_, p.direction);
    const double v = p.inverse_range - inverse_range_ * c;
    const double wc = p.weight * c, ws = p.weight * s;
    sums_[0] += wc * c;
    sums_[1] += wc * s;
    sums_[2] += ws * s;
    sums_[3] += wc * v;
    sums_[4] += ws * v;
    sums_[5] += p.weight * v * v;
  }
  const Sums& sums() const { return sums_; }

  std::size_t groups = 0;  // that began to use it

 private:
  Vec2 axis_;
  double inverse_range_;
  Sums sums_{};
};

double half_misfit(double cc, double cs, double ss, double cv, double sv, double vv) {
  const double det = cc * ss - cs * cs;
  const double explained = ss * cv * cv - 2.0 * cs * cv * sv + cc * sv * sv;
  const double half = 0.5 * (vv - explained / det);
  return half > 0.0 ? half : 0.0;  // NaN of 0/0 gives 0
}

// Starts of lines, one per knot. A line from knot s costs before[s] apart from its misfit, its own cost and what all
// points up to its end cost on lines; the sums of its points are those of the anchor now less those at its start.
struct Starts {
  std::vector<double> before;
  std::array<std::vector<double>, 6> sums;

  explicit Starts(std::size_t knots) : before(knots) {
    for (auto& s : sums) s.resize(knots);
  }
  void set(std::size_t s, double cost, const Sums& now) {
    before[s] = cost;
    for (std::size_t i = 0; i < 6; ++i) sums[i][s] = now[i];
  }
  double misfit(std::size_t s, const Sums& now) const {
    return half_misfit(now[0] - sums[0][s], now[1] - sums[1][s], now[2] - sums[2][s], now[3] - sums[3][s],
                       now[4] - sums[4][s], now[5] - sums[5][s]);
  }
};

// Starts that are looked at together. No line from one of them costs less than the cheapest start and the misfit of the
// points behind the last start, now or at any later end: misfits only grow. While that is dearer than the best cut
// known, none of them needs to be looked at.
struct Group {
  std::size_t begin, end;  // knots
  std::size_t anchor;
  double least_before = kInfinity;
  double bound = -kInfinity;  // of what a line from here costs, as Starts counts
};

// Where lines may begin and end: point indices 0 .. n, every `stride` points and at every gap that no line crosses.
std::vector<std::size_t> knots_of(std::span<const SegmentationPoint> points, int max_knots) {
  const std::size_t n = points.size();
  const auto limit = static_cast<std::size_t>(std::max(max_knots, 1));
  const std::size_t stride = (n + limit - 1) / limit;
  std::vector<std::size_t> knots = {0};
  for (std::size_t i = 1; i < n; ++i)
    if (i - knots.back() >= stride || points[i].gap_cost == kInfinity) knots.push_back(i);
  if (n > 0) knots.push_back(n);
  return knots;
}

// Cost of reaching each knot, and how: the knot where the last line begins, or the previous knot as clutter.
struct Step {
  double cost = 0.0;
  std::size_t from = 0;
  bool is_line = false;
};

Segmentation trace_back(std::span<const Step> steps, std::span<const std::size_t> knots) {
  Segmentation result;
  result.cost = steps.back().cost;
  for (std::size_t k = steps.size() - 1; k > 0; k = steps[k].from)
    if (steps[k].is_line)
      result.lines.push_back({static_cast<int>(knots[steps[k].from]), static_cast<int>(knots[k]) - 1});
  std::reverse(result.lines.begin(), result.lines.end());
  return result;
}

}  // namespace

double LineCost::of(int points) const {
  return base + std::log(static_cast<double>(points));
}

double line_misfit(std::span<const SegmentationPoint> points) {
  if (points.size() <= 2) return 0.0;
  Anchor anchor(points.front());
  for (const SegmentationPoint& p : points) anchor.add(p);
  const Sums& s = anchor.sums();
  return half_misfit(s[0], s[1], s[2], s[3], s[4], s[5]);
}

Segmentation optimal_segmentation(std::span<const SegmentationPoint> points, LineCost line_cost, int max_knots) {
  if (points.empty()) return {};
  const std::vector<std::size_t> knots = knots_of(points, max_knots);
  std::vector<double> logarithm(points.size() + 1, 0.0);
  for (std::size_t k = 1; k < logarithm.size(); ++k) logarithm[k] = std::log(static_cast<double>(k));

  std::vector<Step> steps(knots.size());
  Starts starts(knots.size());
  std::vector<Group> groups;
  std::vector<Anchor> anchors;  // in the order of the groups that use them
  double on_lines = 0.0;        // line_cost and gap_cost of all points so far: what lines cost apart from misfit
  std::size_t since_sweep = 0;
  for (std::size_t k = 1; k < knots.size(); ++k) {
    const std::size_t first = knots[k - 1], last = knots[k];
    if (points[first].gap_cost == kInfinity) {  // no line goes on
      groups.clear();
      anchors.clear();
    }
    // A line may begin here. A gap before its first point is not its own.
    if (points[first].gap_cost < kInfinity) on_lines += points[first].gap_cost;
    if (groups.empty() || groups.back().end - groups.back().begin == kKnotsPerGroup) {
      if (anchors.empty() || anchors.back().groups == kGroupsPerAnchor) anchors.emplace_back(points[first]);
      ++anchors.back().groups;
      groups.push_back({.begin = k - 1, .end = k - 1, .anchor = anchors.size() - 1});
    }
    Group& open = groups.back();
    starts.set(k - 1, steps[k - 1].cost - on_lines, anchors.back().sums());
    open.end = k;
    open.least_before = std::min(open.least_before, starts.before[k - 1]);
    open.bound = std::min(open.bound, starts.before[k - 1]);

    double clutter = 0.0;
    for (std::size_t i = first; i < last; ++i) {
      for (Anchor& a : anchors) a.add(points[i]);
      on_lines += points[i].line_cost + (i > first ? points[i].gap_cost : 0.0);
      clutter += points[i].clutter_cost;
    }

    Step best{.cost = steps[k - 1].cost + clutter, .from = k - 1, .is_line = false};
    const double common = on_lines + line_cost.base;
    const auto look = [&](Group& g) {
      const double fewest_points = logarithm[last - knots[g.end - 1]];
      if (g.bound + common + fewest_points >= best.cost) return;
      const Sums& now = anchors[g.anchor].sums();
      if (last - knots[g.end - 1] > 2) {
        g.bound = std::max(g.bound, g.least_before + starts.misfit(g.end - 1, now));
        if (g.bound + common + fewest_points >= best.cost) return;
      }
      double least = kInfinity;
      for (std::size_t s = g.begin; s < g.end; ++s) {
        const std::size_t n = last - knots[s];
        // Two points always lie on a line; there the formula is 0/0 or nearly.
        const double value = starts.before[s] + (n > 2 ? starts.misfit(s, now) : 0.0);
        least = std::min(least, value);
        const double cost = value + common + logarithm[n];
        if (cost < best.cost) best = {.cost = cost, .from = s, .is_line = true};
      }
      g.bound = std::max(g.bound, least);
    };
    // The line that was best so far first: most often it goes on, and the others need no look.
    if (steps[k - 1].is_line) {
      const auto g = std::ranges::upper_bound(groups, steps[k - 1].from, {}, &Group::begin);
      if (g != groups.begin()) look(*std::prev(g));
    }
    for (Group& g : groups) look(g);
    steps[k] = best;

    // Pruning: if the line from s, ended here without its LineCost, is no cheaper than the best cut up to here, then
    // at any later end that best cut followed by a new line is no dearer, because misfits add up to no more than the
    // misfit of the whole, and LineCost does not grow when a line gets shorter.
    if (++since_sweep < kKnotsPerSweep) continue;
    since_sweep = 0;
    const double limit = best.cost - on_lines;
    std::erase_if(groups, [&](const Group& g) { return g.bound >= limit && g.end < k; });
    // Anchors that no group uses. The last group, never pruned here, keeps the last.
    std::size_t kept = 0;
    for (std::size_t i = 0, a = 0; a < anchors.size(); ++a) {
      bool used = false;
      for (; i < groups.size() && groups[i].anchor == a; ++i) {
        groups[i].anchor = kept;
        used = true;
      }
      if (used) anchors[kept++] = anchors[a];
    }
    anchors.erase(anchors.begin() + static_cast<std::ptrdiff_t>(kept), anchors.end());
  }
  return trace_back(steps, knots);
}

Segmentation optimal_segmentation_at_most(std::span<const SegmentationPoint> points, int max_lines, int max_knots) {
  if (points.empty()) return {};
  const std::vector<std::size_t> knots = knots_of(points, max_knots);
  const auto levels = static_cast<std::size_t>(std::max(max_lines, 0)) + 1;
  const std::size_t n = knots.size();
  // cost[k * levels + m]: reaching knot k with exactly m lines.
  std::vector<double> cost(n * levels, kInfinity);
  std::vector<std::size_t> from(n * levels, 0);
  std::vector<char> is_line(n * levels, 0);
  cost[0] = 0.0;
  for (std::size_t s = 0; s + 1 < n; ++s) {
    const double* here = &cost[s * levels];
    double clutter = 0.0;
    for (std::size_t i = knots[s]; i < knots[s + 1]; ++i) clutter += points[i].clutter_cost;
    for (std::size_t m = 0; m < levels; ++m) {
      const std::size_t next = (s + 1) * levels + m;
      if (here[m] + clutter < cost[next]) {
        cost[next] = here[m] + clutter;
        from[next] = s;
        is_line[next] = 0;
      }
    }
    Anchor anchor(points[knots[s]]);
    double on_line = 0.0;
    for (std::size_t t = s + 1; t < n; ++t) {
      if (t > s + 1 && points[knots[t - 1]].gap_cost == kInfinity) break;
      for (std::size_t i = knots[t - 1]; i < knots[t]; ++i) {
        anchor.add(points[i]);
        on_line += points[i].line_cost + (i > knots[s] ? points[i].gap_cost : 0.0);
      }
      const Sums& a = anchor.sums();
      const double line = on_line + (knots[t] - knots[s] > 2 ? half_misfit(a[0], a[1], a[2], a[3], a[4], a[5]) : 0.0);
      for (std::size_t m = 1; m < levels; ++m) {
        const std::size_t there = t * levels + m;
        if (here[m - 1] + line < cost[there]) {
          cost[there] = here[m - 1] + line;
          from[there] = s;
          is_line[there] = 1;
        }
      }
    }
  }
  const auto end = cost.begin() + static_cast<std::ptrdiff_t>((n - 1) * levels);
  auto m = static_cast<std::size_t>(std::min_element(end, end + static_cast<std::ptrdiff_t>(levels)) - end);
  Segmentation result;
  result.cost = cost[(n - 1) * levels + m];
  if (!(result.cost < kInfinity)) return result;
  for (std::size_t k = n - 1; k > 0;) {
    const std::size_t at = k * levels + m;
    const std::size_t s = from[at];
    if (is_line[at]) {
      result.lines.push_back({static_cast<int>(knots[s]), static_cast<int>(knots[k]) - 1});
      --m;
    }
    k = s;
  }
  std::reverse(result.lines.begin(), result.lines.end());
  return result;
}

}  // namespace scanbench::extract
