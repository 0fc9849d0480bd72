// Climbs of every point under a kernel of its own (Lakaemper 2009, remark at the end of section IV.C).
#include "algorithms/merge/mean_shift/single_phase.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "algorithms/merge/mean_shift/climb.hpp"
#include "algorithms/merge/mean_shift/mode_links.hpp"
#include "algorithms/merge/mean_shift/mode_polish.hpp"
#include "algorithms/merge/mean_shift/modes.hpp"
#include "core/disjoint_sets.hpp"

namespace scanbench::merge {
namespace {

constexpr double kCandidateBox =
    1.0;  // half side of the region that one list of candidates serves, in standard deviations
const double kBoxDiagonal = std::sqrt(3.0) * kCandidateBox;

/// The joint space in units in which no kernel is wider than 1 in any direction.
class SinglePhase {
 public:
  SinglePhase(std::span<const Piece> pieces, const Kernels& kernels)
      : kernels_(kernels),
        scale_u_(std::sqrt(kernels.factor) * kernels.sigma_x_m),
        scale_v_(std::sqrt(kernels.factor) * kernels.sigma_y_m),
        unit_(std::max(scale_u_, scale_v_)),
        angle_scale_(kernels.h_rad_per_m * kernels.sigma_m),
        period_(kPi / angle_scale_),
        points_(joint_space(pieces)),
        grid_(points_, 1.0, period_) {}

  Clustering run(std::span<const Piece> pieces, bool with_paths);

 private:
  std::vector<Vec3> joint_space(std::span<const Piece> pieces) const {
    std::vector<Vec3> points;
    points.reserve(pieces.size());
    for (const Piece& piece : pieces) {
      const Vec2 centre = piece.segment.midpoint();
      points.emplace_back(centre.x() / unit_, centre.y() / unit_, reduced(piece.alpha / angle_scale_, period_));
    }
    return points;
  }
  Vec3 in_world(const Vec3& p) const { return {p.x() * unit_, p.y() * unit_, direction_mod_pi(p.z() * angle_scale_)}; }

  /// The kernel's own frame: u along its direction, v across, z the angle, each in its standard deviations.
  struct Frame {
    Vec2 along;
    double to_u;
    double to_v;
    Vec3 from_grid(const Vec3& d) const {
      return {to_u * along.dot(d.head<2>()), to_v * cross(along, d.head<2>()), d.z()};
    }
    Vec3 to_grid(const Vec3& w) const {
      const Vec2 d = (w.x() / to_u) * along + (w.y() / to_v) * perpendicular(along);
      return {d.x(), d.y(), w.z()};
    }
  };

  /// The mode uphill from the point `start` of the grid, in the density under the frame's kernel.
  Vec3 mode_from(const Vec3& start, const Frame& frame, std::vector<Vec3>* path, bool& converged) const;
  std::vector<int> labels(const std::vector<Vec3>& ends) const;

  const Kernels& kernels_;
  double scale_u_;
  double scale_v_;
  double unit_;
  double angle_scale_;
  double period_;
  std::vector<Vec3> points_;
  PointGrid grid_;
};

Vec3 SinglePhase::mode_from(const Vec3& start, const Frame& frame, std::vector<Vec3>* path, bool& converged) const {
  const auto half = static_cast<float>(kCandidateBox);
  const ClimbRules rules{.squared_cutoff = static_cast<float>(kernels_.cutoff * kernels_.cutoff),
                         .capture = false,
                         .accelerate = kernels_.accelerate,
                         .inner = {half - kLongestFastStep, half - kLongestFastStep, half - kLongestFastStep},
                         .outer = {half, half, half}};
  CandidateList candidates;
  std::vector<Float3> steps_taken;
  Vec3 centre = start;
  int steps = 0;
  int captured_by = -1;
  ClimbEnd state = ClimbEnd::left_box;
  do {
    candidates.clear();
    grid_.for_each_near(centre, Vec3::Zero(), kernels_.cutoff + kBoxDiagonal, [&](std::size_t, const Vec3& d) {
      const Vec3 w = frame.from_grid(d);
      if (w.norm() <= kernels_.cutoff + kBoxDiagonal) candidates.add(Float3::rounded(w));
    });
    candidates.seal();
    Float3 t;
    steps_taken.clear();
    state = climb(candidates, {}, rules, t, steps, captured_by, path != nullptr ? &steps_taken : nullptr);
    const auto absolute = [&](const Float3& p) {
      Vec3 g = centre + frame.to_grid(Vec3(p.x, p.y, p.z));
      g.z() = reduced(g.z(), period_);
      return g;
    };
    for (const Float3& p : steps_taken) path->push_back(absolute(p));
    centre = absolute(t);
  } while (state == ClimbEnd::left_box);
  if (state == ClimbEnd::exhausted) converged = false;

  // The polish uses the frame's coordinates about `origin`; the angle stays absolute.
  const Vec3 origin(centre.x(), centre.y(), 0.0);
  const PolishedMode mode = polish_mode({0.0, 0.0, centre.z()}, period_, [&](const Vec3& at, std::vector<Vec3>& out) {
    out.clear();
    Vec3 g = origin + frame.to_grid(at);
    const double reach = kPolishCutoff + std::sqrt(3.0) * (kPolishBox + 0.5);
    g.z() = reduced(g.z(), period_);
    grid_.for_each_near(g, Vec3::Zero(), reach, [&](std::size_t, const Vec3& d) {
      const Vec3 w = frame.from_grid(d);
      if (w.norm() <= reach) out.push_back(w);
    });
  });
  if (mode.gradient > 1e-6) converged = false;
  const Vec3 end = origin + frame.to_grid(mode.position);
  if (path != nullptr) path->push_back(end);
  return end;
}

std::vector<int> SinglePhase::labels(const std::vector<Vec3>& ends) const {
  // Links as in phase 2: the metric is that of K2 along the mean direction of the two ends, and that of eq. 4 in angle.
  DisjointSets sets(ends.size());
  const double reach = kernels_.epsilon2 * (1.0 + 1e-4) * std::max(1.0, 1.0 / std::sqrt(kernels_.factor));
  const PointGrid grid(ends, std::max(reach, 1e-6), period_);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    grid.for_each_near(ends[i], Vec3::Zero(), reach, [&](std::size_t j, const Vec3& d) {
      if (j >= i) return;
      const Vec2 along = kernel2_axis(kernels_.form, (ends[i].z() + 0.5 * d.z()) * angle_scale_);
      const Frame frame{along, unit_ / scale_u_, unit_ / scale_v_};
      const Vec3 w = frame.from_grid(d);
      // The factor applies to K2 only: epsilon2 is in units of sigma_x, sigma_y and the sigma of the angle without it.
      const Vec2 uv = w.head<2>() * std::sqrt(kernels_.factor);
      if (uv.squaredNorm() + w.z() * w.z() <= kernels_.epsilon2 * kernels_.epsilon2 * (1.0 + 1e-4)) sets.unite(i, j);
    });
  }
  return sets.labels();
}

Clustering SinglePhase::run(std::span<const Piece> pieces, bool with_paths) {
  const std::size_t n = pieces.size();
  Clustering result;
  result.end.resize(n);
  if (with_paths) result.paths.resize(n);
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) { return std::array{points_[i].x(), points_[i].y(), points_[i].z()}; };
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return std::pair(key(a), a) < std::pair(key(b), b); });
  std::vector<Vec3> ends(n);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = order[k];
    if (k > 0 && points_[i] == points_[order[k - 1]]) {  // equal points have the same path
      ends[i] = ends[order[k - 1]];
      if (with_paths) result.paths[i] = result.paths[order[k - 1]];
      continue;
    }
    std::vector<Vec3> path{points_[i]};
    const Frame frame{kernel2_axis(kernels_.form, pieces[i].alpha), unit_ / scale_u_, unit_ / scale_v_};
    ends[i] = mode_from(points_[i], frame, with_paths ? &path : nullptr, result.converged);
    if (with_paths)
      for (const Vec3& p : path) result.paths[i].push_back(in_world(p));
  }
  result.cluster = labels(ends);
  for (const int c : result.cluster) result.clusters = std::max(result.clusters, c + 1);
  for (std::size_t i = 0; i < n; ++i) result.end[i] = in_world(ends[i]);
  return result;
}

}  // namespace

Clustering cluster_in_one_phase(std::span<const Piece> pieces, const Kernels& kernels, bool with_paths) {
  return SinglePhase(pieces, kernels).run(pieces, with_paths);
}

}  // namespace scanbench::merge
