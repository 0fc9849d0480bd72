// Dynamic programme for the best chains on a grid. docs/algorithms/polyline.md, section 2.
#include "algorithms/extract/polyline/search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/index.hpp"
#include "core/special_values.hpp"

namespace scanbench::extract {
namespace {

constexpr double kProhibitive = 1e6;  // [nats], finite, because differences of sums are formed
// A wall spans less than half a turn and more than rounding errors.
constexpr double kLeastSine = 1e-9;
constexpr double kLeastCosine = -0.99;

// RunSums over points of w (d d', d v, v v), and of their cost on a wall without the misfit.
struct RunSums {
  double xx = 0, xy = 0, yy = 0, xv = 0, yv = 0, vv = 0, fixed = 0;

  RunSums operator-(const RunSums& o) const {
    return {xx - o.xx, xy - o.xy, yy - o.yy, xv - o.xv, yv - o.yv, vv - o.vv, fixed - o.fixed};
  }
};

std::vector<RunSums> running_sums(std::span<const SegmentationPoint> points) {
  std::vector<RunSums> sums(points.size() + 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SegmentationPoint& p = points[i];
    RunSums s = sums[i];
    const double w = p.weight, x = p.direction.x(), y = p.direction.y(), v = p.inverse_range;
    s.xx += w * x * x;
    s.xy += w * x * y;
    s.yy += w * y * y;
    s.xv += w * x * v;
    s.yv += w * y * v;
    s.vv += w * v * v;
    s.fixed += p.line_cost + (p.gap_cost < kInf ? p.gap_cost : 0.0);
    sums[i + 1] = s;
  }
  return sums;
}

// The cost of the points after one vertex up to the next, as a quadratic form of the two inverse ranges.
class WallCost {
 public:
  WallCost(const Vec2& p, const Vec2& q, const RunSums& s) : one_(0.5 * s.vv), fixed_(s.fixed) {
    // theta = u_p f + u_q g is the wall: theta . p = u_p, theta . q = u_q.
    const double sine = cross(p, q);
    const Vec2 f = -perpendicular(q) / sine, g = perpendicular(p) / sine;
    const auto form = [&](const Vec2& a, const Vec2& b) {
      return a.x() * (s.xx * b.x() + s.xy * b.y()) + a.y() * (s.xy * b.x() + s.yy * b.y());
    };
    pp_ = 0.5 * form(f, f);
    pq_ = form(f, g);
    qq_ = 0.5 * form(g, g);
    p_ = -(f.x() * s.xv + f.y() * s.yv);
    q_ = -(g.x() * s.xv + g.y() * s.yv);
  }
  double cost(double u_p, double u_q) const {
    const double half_misfit = u_p * (pp_ * u_p + pq_ * u_q + p_) + u_q * (qq_ * u_q + q_) + one_;
    return fixed_ + std::max(half_misfit, 0.0);
  }

  // Not more than any cost(u_p, u_q), rounding included: the points' misfit on their best line.
  double least_cost() const {
    const double squares = 4.0 * pp_ * qq_, determinant = squares - pq_ * pq_;
    if (!(determinant > kLeastDeterminant * squares)) return fixed_;
    const double gain = (qq_ * p_ * p_ - pq_ * p_ * q_ + pp_ * q_ * q_) / determinant;
    return fixed_ + std::max(one_ - gain - kRounding * one_, 0.0);
  }
  // The same for a given u_q.
  double least_cost(double u_q) const {
    if (!(pp_ > kLeastDeterminant * qq_)) return fixed_;
    const double slope = pq_ * u_q + p_;
    const double half_misfit = u_q * (qq_ * u_q + q_) + one_ - 0.25 * slope * slope / pp_;
    return fixed_ + std::max(half_misfit - kRounding * one_, 0.0);
  }

 private:
  // The terms of the misfit are about one_ and cancel. Rounding errors of the least misfit grow with the inverse of
  // the determinant: they are far below kRounding * one_ as long as it is not near 0.
  static constexpr double kLeastDeterminant = 1e-5;
  static constexpr double kRounding = 1e-9;

  double pp_, pq_, qq_, p_, q_, one_, fixed_;
};

// One programme. A state is a place (a point that may have a vertex), the choice of its inverse range, and the number m
// of vertices so far. If their number is free, there is no count: m is 0 and each vertex has a cost.
class Programme {
 public:
  static Programme counted(std::span<const SegmentationPoint> points, const VertexChoices& choices, int max_vertices,
                           int stride) {
    return {points, choices, as_index(max_vertices) + 1, 1, 0.0, stride};
  }
  static Programme free(std::span<const SegmentationPoint> points, const VertexChoices& choices, double vertex_cost,
                        int stride) {
    return {points, choices, 1, 0, vertex_cost, stride};
  }

 private:
  Programme(std::span<const SegmentationPoint> points, const VertexChoices& choices, std::size_t levels,
            std::size_t step, double vertex_cost, int stride)
      : points_(points), levels_(levels), step_(step), vertex_cost_(vertex_cost), sums_(running_sums(points)) {
    const int n = static_cast<int>(points.size());
    for (int i = 0; i < n; ++i) {
      const bool gap_before = i > 0 && points[as_index(i)].gap_cost == kInf;
      const bool gap_after = i + 1 < n && points[as_index(i + 1)].gap_cost == kInf;
      if (i % stride == 0 || i == n - 1 || gap_before || gap_after) places_.push_back(i);
      blocks_.push_back((blocks_.empty() ? 0 : blocks_.back()) + (gap_before ? 1 : 0));
    }
    width_ = choices.empty() ? 0 : choices.front().size();
    open_.assign(places_.size() * width_ * levels_, kInf);
    done_.assign((places_.size() + 1) * levels_, kInf);
    clutter_.assign(as_index(n) + 1, 0.0);
    for (int i = 0; i < n; ++i) clutter_[as_index(i) + 1] = clutter_[as_index(i)] + points[as_index(i)].clutter_cost;
    set_begins(choices);
  }

 public:
  // Any number of chains with clutter between them. `vertex_cost`: of each vertex, if they are counted.
  GridChains run(double vertex_cost) {
    for (std::size_t m = 0; m < levels_; ++m) done_[m] = 0.0;
    for (std::size_t p = 0; p < places_.size(); ++p) {
      close(p);  // before a chain begins here, because a single vertex is not a chain
      for (std::size_t a = 0; a < width_; ++a)
        for (std::size_t m = step_; m < levels_; ++m)
          relax(open(p, a, m), done_[p * levels_ + m - step_] + begin_cost(p, a) + vertex_cost_);
      extend(p);
    }
    std::size_t best = 0;
    const auto cost = [&](std::size_t m) {
      return done_[places_.size() * levels_ + m] + static_cast<double>(m) * vertex_cost;
    };
    for (std::size_t m = 1; m < levels_; ++m)
      if (cost(m) < cost(best)) best = m;
    return trace_back(best);
  }

  // One chain from the first place to the last, both with the same inverse range, choice `a` there.
  GridChains run_closed(std::size_t a) {
    open(0, a, 1) = begin_cost(0, a);
    for (std::size_t p = 0; p + 1 < places_.size(); ++p) extend(p);
    return trace_back_closed(a);
  }

 private:
  GridChains trace_back(std::size_t m) const {
    GridChains result;
    result.cost = done_[places_.size() * levels_ + m];
    std::size_t vertices = 0;
    for (std::size_t p = places_.size(); p > 0;) {
      Extension best;
      std::size_t choice_of_best = 0;
      for (std::size_t a = 0; a < width_; ++a)
        if (const Extension e = extension(p - 1, a, m); e.cost < best.cost) best = e, choice_of_best = a;
      // Compares the two alternatives, not the stored cost: sums in another order differ in the last bits.
      if (done_[(p - 1) * levels_ + m] + clutter_from(p - 1) <= best.cost + clutter_after(p - 1)) {
        --p;
        continue;
      }
      result.chains.push_back(trace_chain(p - 1, choice_of_best, m));
      p = place_of(result.chains.back().front().point);
      vertices += result.chains.back().size();
      m -= step_ * result.chains.back().size();
    }
    result.cost -= static_cast<double>(vertices) * vertex_cost_;
    std::ranges::reverse(result.chains);
    return result;
  }

  GridChains trace_back_closed(std::size_t a) const {
    GridChains result;
    result.cost = open(places_.size() - 1, a, levels_ - 1);
    if (result.cost < kInf) result.chains.push_back(trace_chain(places_.size() - 1, a, levels_ - 1));
    return result;
  }

  std::size_t place_of(int point) const { return as_index(std::ranges::lower_bound(places_, point) - places_.begin()); }

  static void relax(double& cost, double candidate) { cost = std::min(cost, candidate); }

  const SegmentationPoint& point(std::size_t p) const { return points_[as_index(places_[p])]; }
  double choice(std::size_t p, std::size_t a) const { return at_places_[p * width_ + a]; }
  double& open(std::size_t p, std::size_t a, std::size_t m) { return open_[(p * width_ + a) * levels_ + m]; }
  double open(std::size_t p, std::size_t a, std::size_t m) const { return open_[(p * width_ + a) * levels_ + m]; }

  // The first vertex of a chain pays for its own point, later ones for all points after the vertex before.
  double begin_cost(std::size_t p, std::size_t a) const { return begins_[p * width_ + a]; }

  void set_begins(const VertexChoices& choices) {
    for (const int place : places_)
      for (const double inverse_range : choices[as_index(place)]) at_places_.push_back(inverse_range);
    begins_.resize(places_.size() * width_);
    for (std::size_t p = 0; p < places_.size(); ++p) {
      double cheapest = kInf, dearest = 0.0;
      for (std::size_t a = 0; a < width_; ++a) {
        const double e = point(p).inverse_range - choice(p, a);
        const double begin = begins_[p * width_ + a] = point(p).line_cost + 0.5 * point(p).weight * e * e;
        cheapest = std::min(cheapest, begin);
        dearest = std::max(dearest, begin);
      }
      most_saved_before_.push_back(std::max(0.0, point(p).clutter_cost - cheapest));
      most_paid_after_.push_back(std::max(dearest, point(p).clutter_cost));
    }
  }

  // Clutter cost from this place up to the next place or the end.
  double clutter_from(std::size_t p) const {
    const int next = p + 1 < places_.size() ? places_[p + 1] : static_cast<int>(points_.size());
    return clutter_[as_index(next)] - clutter_[as_index(places_[p])];
  }

  // The same without the point at this place.
  double clutter_after(std::size_t p) const {
    const int next = p + 1 < places_.size() ? places_[p + 1] : static_cast<int>(points_.size());
    return clutter_[as_index(next)] - clutter_[as_index(places_[p]) + 1];
  }

  // done(p): the cost of all points before place p, without an unfinished chain.
  void close(std::size_t p) {
    const double rest = clutter_after(p);
    for (std::size_t m = 0; m < levels_; ++m) {
      double& done = done_[(p + 1) * levels_ + m];
      relax(done, done_[p * levels_ + m] + clutter_from(p));
      for (std::size_t a = 0; a < width_; ++a) relax(done, open(p, a, m) + rest);
    }
  }

  bool wall_between(std::size_t p, std::size_t q) const {
    return blocks_[as_index(places_[p])] == blocks_[as_index(places_[q])] &&
           cross(point(p).direction, point(q).direction) > kLeastSine &&
           point(p).direction.dot(point(q).direction) > kLeastCosine;
  }
  WallCost wall(std::size_t p, std::size_t q) const {
    RunSums sums = sums_[as_index(places_[q]) + 1] - sums_[as_index(places_[p]) + 1];
    if (places_[q] == places_[p] + 1) sums.fixed += kBareWall;
    return {point(p).direction, point(q).direction, sums};
  }

  void extend(std::size_t p) {
    bool any = false;
    for (std::size_t q = p + 1; q < places_.size(); ++q) {
      if (!wall_between(p, q)) {
        if (any) break;
        continue;
      }
      any = true;
      const WallCost w = wall(p, q);
      // A wall that costs more than clutter between p and q is never needed. Instead, the chain ends at p (or p is
      // clutter too, if the chain began there), and a chain begins at q (or q is clutter too, if it would end there).
      const double apart = clutter_[as_index(places_[q])] - clutter_[as_index(places_[p]) + 1];
      const double most_saved = most_saved_before_[p];
      if (w.least_cost() > apart + most_paid_after_[q] + most_saved) continue;
      for (std::size_t b = 0; b < width_; ++b) {
        const double limit = apart + std::max(begin_cost(q, b), point(q).clutter_cost);
        if (w.least_cost(choice(q, b)) > limit + most_saved) continue;
        if (step_ == 0) {
          extend_free(p, w, q, b);
          continue;
        }
        double* to = &open(q, b, 0);
        for (std::size_t a = 0; a < width_; ++a) {
          const double cost = w.cost(choice(p, a), choice(q, b));
          if (!(cost <= limit + std::max(0.0, point(p).clutter_cost - begin_cost(p, a)))) continue;
          const double* from = &open(p, a, 0);
          for (std::size_t m = step_; m < levels_; ++m)
            to[m] = std::min(to[m], from[m - step_] + (cost + vertex_cost_));
        }
      }
    }
  }

  // One state, without branches: which of two costs is less is chance.
  void extend_free(std::size_t p, const WallCost& w, std::size_t q, std::size_t b) {
    const double u_q = choice(q, b);
    const double* from = &open_[p * width_];
    const double* u_p = &at_places_[p * width_];
    double best = open(q, b, 0);
    for (std::size_t a = 0; a < width_; ++a) best = std::min(best, from[a] + (w.cost(u_p[a], u_q) + vertex_cost_));
    open(q, b, 0) = best;
  }

  // The best wall that ends at (p, a), the m-th vertex.
  struct Extension {
    double cost = kInf;
    std::size_t place = 0;
    std::size_t choice = 0;
  };
  Extension extension(std::size_t p, std::size_t a, std::size_t m) const {
    Extension best;
    if (m < step_) return best;
    for (std::size_t s = 0; s < p; ++s) {
      if (!wall_between(s, p)) continue;
      const WallCost w = wall(s, p);
      for (std::size_t c = 0; c < width_; ++c) {
        const double cost = open(s, c, m - step_) + (w.cost(choice(s, c), choice(p, a)) + vertex_cost_);
        if (cost < best.cost) best = {cost, s, c};
      }
    }
    return best;
  }

  // The chain of two or more vertices that ends at (p, a), m vertices in all.
  std::vector<GridVertex> trace_chain(std::size_t p, std::size_t a, std::size_t m) const {
    std::vector<GridVertex> chain;
    for (;; m -= step_) {
      const Extension before = extension(p, a, m);
      const bool begins =
          !chain.empty() && !(before.cost < done_[p * levels_ + m - step_] + begin_cost(p, a) + vertex_cost_);
      chain.push_back({places_[p], choice(p, a)});
      if (begins || !(before.cost < kInf)) break;
      p = before.place;
      a = before.choice;
    }
    std::ranges::reverse(chain);
    return chain;
  }

  std::span<const SegmentationPoint> points_;
  std::size_t levels_, width_ = 0;
  std::size_t step_;  // of m at a vertex
  double vertex_cost_;
  std::vector<RunSums> sums_;
  std::vector<int> places_;
  std::vector<int> blocks_;  // per point: the number of infinite gaps before it
  std::vector<double> open_, done_, clutter_;
  std::vector<double> at_places_;                            // the choices, per place
  std::vector<double> begins_;                               // per place and choice
  std::vector<double> most_saved_before_, most_paid_after_;  // per place: bounds of what a wall may cost over clutter
};

}  // namespace

GridChains best_chains(std::span<const SegmentationPoint> points, const VertexChoices& choices, int max_vertices,
                       double vertex_cost, int stride) {
  if (points.empty()) return {};
  if (vertex_cost > 0) {
    // Without a count there is a state where a count needs one for each number of vertices. If the best of all numbers
    // is within the limit, it is also the best with a count.
    GridChains best = Programme::free(points, choices, vertex_cost, stride).run(0.0);
    std::size_t vertices = 0;
    for (const auto& chain : best.chains) vertices += chain.size();
    if (vertices <= as_index(max_vertices)) return best;
  }
  return Programme::counted(points, choices, max_vertices, stride).run(vertex_cost);
}

GridChains best_closed_chain(std::span<const SegmentationPoint> points, const VertexChoices& choices, int vertices,
                             int stride, const GridVertex& fixed) {
  // The scan from the fixed vertex to the same vertex a turn later.
  const int n = static_cast<int>(points.size());
  std::vector<SegmentationPoint> rotated;
  VertexChoices rotated_choices;
  for (int i = 0; i <= n; ++i) {
    const auto k = as_index((fixed.point + i) % n);
    rotated.push_back(points[k]);
    rotated.back().clutter_cost = kProhibitive;
    rotated_choices.push_back(choices[k]);
  }
  rotated.back().weight = 0.0;  // the first vertex pays for the point
  rotated.back().line_cost = 0.0;
  rotated_choices.front().front() = rotated_choices.back().front() = fixed.inverse_range;
  GridChains result = Programme::counted(rotated, rotated_choices, vertices + 1, stride).run_closed(0);
  for (auto& chain : result.chains)
    for (GridVertex& v : chain) v.point += fixed.point;
  return result;
}

}  // namespace scanbench::extract
