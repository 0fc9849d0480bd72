// The dynamic programme of the optimal extractor. docs/algorithms/optimal.md, sections 3 and 4.
//
// F(t) is the length of the shortest description of the points before t. With C(s, t), the misfit and the code lengths
// of the points s .. t-1 on one line, and K(n), the code length of a line of n points:
//
//   F(0) = 0
//   F(t) = min( F(t - 1) + clutter(t - 1),  min over s < t of F(s) + C(s, t) + K(t - s) )
//
// s and t run over the knots, the places where lines may begin and end.
#include "algorithms/extract/optimal/segmentation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/index.hpp"
#include "core/special_values.hpp"

namespace scanbench::extract {
namespace {

constexpr std::size_t kKnotsPerGroup = 16;
constexpr std::size_t kGroupsPerAnchor = 4;
constexpr std::size_t kKnotsPerSweep = 8;  // pruned groups are removed after this number of knots

// LineSums of w * (cos^2, cos sin, sin^2, cos v, sin v, v^2) over points, in the frame of an anchor.
using LineSums = std::array<double, 6>;

// LineSums in a frame near their points: its axis is the direction of the first point, and inverse ranges are counted
// from an arc at that point. LineSums over the whole scan would lose the misfit of a few adjacent beams to
// cancellation.
class AnchoredSums {
 public:
  explicit AnchoredSums(const SegmentationPoint& p) : axis_(p.direction), inverse_range_(p.inverse_range) {}

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
  const LineSums& sums() const { return sums_; }

  std::size_t groups = 0;  // number of groups of starts that used it

 private:
  Vec2 axis_;
  double inverse_range_;
  LineSums sums_{};
};

double half_misfit(double cc, double cs, double ss, double cv, double sv, double vv) {
  const double det = cc * ss - cs * cs;
  const double explained = ss * cv * cv - 2.0 * cs * cv * sv + cc * sv * sv;
  const double half = 0.5 * (vv - explained / det);
  return half > 0.0 ? half : 0.0;  // NaN of 0/0 gives 0
}

double half_misfit(const LineSums& s) {
  return half_misfit(s[0], s[1], s[2], s[3], s[4], s[5]);
}

// The misfit is computed only from three points on, because two points are always on a line and the formula is 0/0
// there.
bool has_misfit(std::size_t n) {
  return n > 2;
}

// The knots: point indices from 0 to n, one every `stride` points and one at every gap that no line crosses.
std::vector<std::size_t> knots_of(std::span<const SegmentationPoint> points, int max_knots) {
  const std::size_t n = points.size();
  const auto limit = as_index(std::max(max_knots, 1));
  const std::size_t stride = (n + limit - 1) / limit;
  std::vector<std::size_t> knots = {0};
  for (std::size_t i = 1; i < n; ++i)
    if (i - knots.back() >= stride || points[i].gap_cost == kInf) knots.push_back(i);
  if (n > 0) knots.push_back(n);
  return knots;
}

// Starts of lines, one per knot. A line from knot s to knot t costs
//   base[s] + misfit(s, t) + [code lengths of all points up to t, as if on lines] + K,
// where base[s] = F(s) less the code lengths of all points up to s. The sums of the line's points are those of its
// anchor at t less those at s.
struct Start {
  double base = 0.0;
  double bound = 0.0;  // lower bound of base + misfit: its last value, because misfits never decrease
  LineSums sums{};

  double misfit(const LineSums& at_end) const {
    return half_misfit(at_end[0] - sums[0], at_end[1] - sums[1], at_end[2] - sums[2], at_end[3] - sums[3],
                       at_end[4] - sums[4], at_end[5] - sums[5]);
  }
};

// The logarithms of 1 .. n at their own indices. Those of most scans are computed once.
class Logarithms {
 public:
  explicit Logarithms(std::size_t n) {
    static const std::vector<double> few = table(1024);
    if (n >= few.size()) own_ = table(n);
    table_ = own_.empty() ? few : own_;
  }
  double operator()(std::size_t n) const { return table_[n]; }

 private:
  static std::vector<double> table(std::size_t n) {
    std::vector<double> result(n + 1, 0.0);
    for (std::size_t k = 1; k <= n; ++k) result[k] = std::log(static_cast<double>(k));
    return result;
  }
  std::vector<double> own_;
  std::span<const double> table_;
};

// Neighbouring starts with a common lower bound. A line from one of them costs at least the cheapest start plus the
// misfit of the points behind the last start. This bound also holds at every later end, because misfits never decrease.
// While it is above the cost of the best known cut, none of the starts is tried.
struct BeamGroup {
  std::size_t begin, end;  // in knots
  std::size_t anchor;
  double least_base = kInf;
  double bound = -kInf;  // lower bound of base + misfit
};

// The last step of the best description of the points before a knot: a line from `from`, or clutter.
struct Step {
  double cost = 0.0;  // F
  std::size_t from = 0;
  bool is_line = false;
};

// Evaluates the recurrence above, knot by knot.
class Recurrence {
 public:
  Recurrence(std::span<const SegmentationPoint> points, LineCost line_cost, int max_knots)
      : points_(points),
        line_base_(line_cost.base),
        knots_(knots_of(points, max_knots)),
        logarithm_(points.size()),
        steps_(knots_.size()),
        starts_(knots_.size()) {}

  Segmentation run() {
    for (std::size_t t = 1; t < knots_.size(); ++t) {
      allow_start(t - 1);
      const double clutter = add_points(t);
      Step best{.cost = steps_[t - 1].cost + clutter, .from = t - 1, .is_line = false};
      try_lines_to(t, best);
      steps_[t] = best;
      prune(t);
    }
    return traced_back();
  }

 private:
  // Allows lines to start at knot s.
  void allow_start(std::size_t s) {
    const SegmentationPoint& first = points_[knots_[s]];
    if (first.gap_cost == kInf) {  // no line continues
      groups_.clear();
      anchors_.clear();
    } else {
      on_lines_ += first.gap_cost;  // added before the start, because the line that begins here does not pay for it
    }
    if (groups_.empty() || groups_.back().end - groups_.back().begin == kKnotsPerGroup) {
      if (anchors_.empty() || anchors_.back().groups == kGroupsPerAnchor) anchors_.emplace_back(first);
      ++anchors_.back().groups;
      groups_.push_back({.begin = s, .end = s, .anchor = anchors_.size() - 1});
    }
    BeamGroup& group = groups_.back();
    const double base = steps_[s].cost - on_lines_;
    starts_[s] = {.base = base, .bound = base, .sums = anchors_.back().sums()};
    group.end = s + 1;
    group.least_base = std::min(group.least_base, base);
    group.bound = std::min(group.bound, base);
  }

  // Adds the points between knots t - 1 and t to all sums; returns their cost as clutter.
  double add_points(std::size_t t) {
    const std::size_t first = knots_[t - 1], last = knots_[t];
    double clutter = 0.0;
    for (std::size_t i = first; i < last; ++i) {
      for (AnchoredSums& a : anchors_) a.add(points_[i]);
      on_lines_ += points_[i].line_cost + (i > first ? points_[i].gap_cost : 0.0);
      clutter += points_[i].clutter_cost;
    }
    return clutter;
  }

  // min over s < t of F(s) + C(s, t) + K(t - s), if it is less than the best so far.
  void try_lines_to(std::size_t t, Step& best) {
    // The line that was best one knot earlier is tried first. It most often continues, and its cost then excludes the
    // others by their bounds.
    if (steps_[t - 1].is_line) {
      const std::size_t from = steps_[t - 1].from;
      const auto group = std::ranges::upper_bound(groups_, from, {}, &BeamGroup::begin);
      if (group != groups_.begin() && from < std::prev(group)->end) try_line(*std::prev(group), from, t, best);
    }
    for (BeamGroup& group : groups_) try_lines_from(group, t, best);
  }

  void try_line(const BeamGroup& group, std::size_t s, std::size_t t, Step& best) {
    const std::size_t n = knots_[t] - knots_[s];
    Start& start = starts_[s];
    if (has_misfit(n)) start.bound = std::max(start.bound, start.base + start.misfit(anchors_[group.anchor].sums()));
    const double cost = start.bound + on_lines_ + line_base_ + logarithm_(n);
    if (cost < best.cost) best = {.cost = cost, .from = s, .is_line = true};
  }

  void try_lines_from(BeamGroup& group, std::size_t t, Step& best) {
    const std::size_t fewest_points = knots_[t] - knots_[group.end - 1];
    const double common = on_lines_ + line_base_ + logarithm_(fewest_points);
    if (group.bound + common >= best.cost) return;
    const bool has_best = best.is_line && best.from >= group.begin && best.from < group.end;
    if (has_misfit(fewest_points) && !has_best) {  // else the bound cannot exclude the group
      const double misfit = starts_[group.end - 1].misfit(anchors_[group.anchor].sums());
      group.bound = std::max(group.bound, group.least_base + misfit);
      if (group.bound + common >= best.cost) return;
    }
    double least = kInf;
    for (std::size_t s = group.begin; s < group.end; ++s) {
      if (starts_[s].bound + common < best.cost) try_line(group, s, t, best);
      least = std::min(least, starts_[s].bound);
    }
    group.bound = std::max(group.bound, least);
  }

  // Suppose the line from s, ended at t without its LineCost, costs at least F(t). Then at any later end the cut of
  // F(t) followed by a new line costs no more than a longer line from s, because the misfits of the parts add up to at
  // most the misfit of the whole, and LineCost does not grow when a line gets shorter. So s is never needed again.
  void prune(std::size_t t) {
    if (++since_sweep_ < kKnotsPerSweep) return;
    since_sweep_ = 0;
    const double limit = steps_[t].cost - on_lines_;
    std::erase_if(groups_, [&](const BeamGroup& g) { return g.bound >= limit && g.end < t; });
    // Drops anchors that no group uses. The last group is never pruned here and keeps the last anchor.
    std::size_t kept = 0;
    for (std::size_t i = 0, a = 0; a < anchors_.size(); ++a) {
      bool used = false;
      for (; i < groups_.size() && groups_[i].anchor == a; ++i) {
        groups_[i].anchor = kept;
        used = true;
      }
      if (used) anchors_[kept++] = anchors_[a];
    }
    anchors_.erase(anchors_.begin() + static_cast<std::ptrdiff_t>(kept), anchors_.end());
  }

  Segmentation traced_back() const {
    Segmentation result;
    result.cost = steps_.back().cost;
    for (std::size_t t = steps_.size() - 1; t > 0; t = steps_[t].from)
      if (steps_[t].is_line)
        result.lines.push_back({static_cast<int>(knots_[steps_[t].from]), static_cast<int>(knots_[t]) - 1});
    std::ranges::reverse(result.lines);
    return result;
  }

  std::span<const SegmentationPoint> points_;
  double line_base_;
  std::vector<std::size_t> knots_;
  Logarithms logarithm_;
  std::vector<Step> steps_;
  std::vector<Start> starts_;
  std::vector<BeamGroup> groups_;
  std::vector<AnchoredSums> anchors_;  // in the order of the groups that use them
  double on_lines_ = 0.0;              // line_cost and gap_cost of all points so far
  std::size_t since_sweep_ = 0;
};

// With F_m(t) for exactly m lines and no LineCost:
//   F_m(t) = min( F_m(t - 1) + clutter(t - 1),  min over s < t of F_{m-1}(s) + C(s, t) )
// Computed forwards: each knot s improves all later knots.
class BoundedRecurrence {
 public:
  BoundedRecurrence(std::span<const SegmentationPoint> points, int max_lines, int max_knots)
      : points_(points),
        knots_(knots_of(points, max_knots)),
        levels_(as_index(std::max(max_lines, 0)) + 1),
        steps_(knots_.size() * levels_, {.cost = kInf}) {
    step(0, 0).cost = 0.0;
  }

  Segmentation run() {
    for (std::size_t s = 0; s + 1 < knots_.size(); ++s) {
      continue_as_clutter(s);
      continue_as_lines(s);
    }
    return traced_back();
  }

 private:
  Step& step(std::size_t knot, std::size_t lines) { return steps_[knot * levels_ + lines]; }
  const Step& step(std::size_t knot, std::size_t lines) const { return steps_[knot * levels_ + lines]; }

  void continue_as_clutter(std::size_t s) {
    double clutter = 0.0;
    for (std::size_t i = knots_[s]; i < knots_[s + 1]; ++i) clutter += points_[i].clutter_cost;
    for (std::size_t m = 0; m < levels_; ++m) improve(step(s + 1, m), {step(s, m).cost + clutter, s, false});
  }

  void continue_as_lines(std::size_t s) {
    AnchoredSums sums(points_[knots_[s]]);
    double on_line = 0.0;
    for (std::size_t t = s + 1; t < knots_.size(); ++t) {
      if (t > s + 1 && points_[knots_[t - 1]].gap_cost == kInf) break;
      for (std::size_t i = knots_[t - 1]; i < knots_[t]; ++i) {
        sums.add(points_[i]);
        on_line += points_[i].line_cost + (i > knots_[s] ? points_[i].gap_cost : 0.0);
      }
      const double line = on_line + (has_misfit(knots_[t] - knots_[s]) ? half_misfit(sums.sums()) : 0.0);
      for (std::size_t m = 1; m < levels_; ++m) improve(step(t, m), {step(s, m - 1).cost + line, s, true});
    }
  }

  static void improve(Step& known, const Step& candidate) {
    if (candidate.cost < known.cost) known = candidate;
  }

  Segmentation traced_back() const {
    const std::size_t n = knots_.size() - 1;
    std::size_t m = 0;
    for (std::size_t k = 1; k < levels_; ++k)
      if (step(n, k).cost < step(n, m).cost) m = k;
    Segmentation result;
    result.cost = step(n, m).cost;
    if (!(result.cost < kInf)) return result;
    for (std::size_t t = n; t > 0;) {
      const Step& last = step(t, m);
      if (last.is_line) {
        result.lines.push_back({static_cast<int>(knots_[last.from]), static_cast<int>(knots_[t]) - 1});
        --m;
      }
      t = last.from;
    }
    std::ranges::reverse(result.lines);
    return result;
  }

  std::span<const SegmentationPoint> points_;
  std::vector<std::size_t> knots_;
  std::size_t levels_;  // numbers of lines, 0 .. max_lines
  std::vector<Step> steps_;
};

}  // namespace

double LineCost::of(int points) const {
  return base + std::log(static_cast<double>(points));
}

double line_misfit(std::span<const SegmentationPoint> points) {
  if (!has_misfit(points.size())) return 0.0;
  AnchoredSums sums(points.front());
  for (const SegmentationPoint& p : points) sums.add(p);
  return half_misfit(sums.sums());
}

Segmentation optimal_segmentation(std::span<const SegmentationPoint> points, LineCost line_cost, int max_knots) {
  if (points.empty()) return {};
  return Recurrence(points, line_cost, max_knots).run();
}

Segmentation optimal_segmentation_at_most(std::span<const SegmentationPoint> points, int max_lines, int max_knots) {
  if (points.empty()) return {};
  return BoundedRecurrence(points, max_lines, max_knots).run();
}

}  // namespace scanbench::extract
