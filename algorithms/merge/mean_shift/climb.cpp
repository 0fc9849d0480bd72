// Mean-shift steps (Lakaemper 2009, eq. 1) and, where they are slow, Newton steps.
//
// Along a wall that was seen often, the density is a ridge with faint ripples. There eq. 1 makes hundreds of shifts of
// a hundredth of a standard deviation. Newton steps on the log density replace them. They use the same sums and end at
// the same modes. They never descend; if they would, a step of eq. 1 is made instead. They are short compared with the
// distance of modes.
#include "algorithms/merge/mean_shift/climb.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>
#include <Eigen/LU>

#include "core/geometry/symmetric_matrix.hpp"

namespace scanbench::merge {
namespace {

constexpr float kSlowShift = 0.15F;
constexpr double kClimbCurvatureFloor = 0.02;
constexpr float kGoal = 1e-5F;      // largest Newton step at convergence: about the resolution of float
constexpr float kFlatGoal = 1e-6F;  // largest shift at convergence
constexpr float kRounding = 1e-6F;  // relative error of a density

Float3 operator+(const Float3& a, const Float3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Float3 operator-(const Float3& a, const Float3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

bool inside(const Float3& t, const Float3& box) {
  return std::abs(t.x) <= box.x && std::abs(t.y) <= box.y && std::abs(t.z) <= box.z;
}

Float3 shortened(const Eigen::Vector3d& v) {
  const double length = v.norm();
  const Eigen::Vector3d u = length > kLongestFastStep ? Eigen::Vector3d(v * (kLongestFastStep / length)) : v;
  return {static_cast<float>(u.x()), static_cast<float>(u.y()), static_cast<float>(u.z())};
}

/// Newton's step with the absolute values of the curvatures: uphill for any Hessian.
Float3 fast_step(const ShiftAndCovariance& s) {
  Eigen::Matrix3d minus_hessian;
  minus_hessian << 1.0 - double{s.xx}, -double{s.xy}, -double{s.xz}, -double{s.xy}, 1.0 - double{s.yy}, -double{s.yz},
      -double{s.xz}, -double{s.yz}, 1.0 - double{s.zz};
  const Eigen::Vector3d gradient(s.shift.step.x, s.shift.step.y, s.shift.step.z);
  const Eigen::Matrix3d beyond_floor = minus_hessian - kClimbCurvatureFloor * Eigen::Matrix3d::Identity();
  const double minor = beyond_floor(0, 0) * beyond_floor(1, 1) - beyond_floor(0, 1) * beyond_floor(0, 1);
  if (beyond_floor(0, 0) > 0 && minor > 0 && beyond_floor.determinant() > 0)  // every curvature above the floor
    return shortened(minus_hessian.inverse() * gradient);

  const SymmetricEigen<Eigen::Matrix3d> eigen = fast_symmetric_eigen(minus_hessian);
  Eigen::Vector3d along_axes = eigen.vectors.transpose() * gradient;
  for (int k = 0; k < 3; ++k) along_axes[k] /= std::max(std::abs(eigen.values[k]), kClimbCurvatureFloor);
  return shortened(eigen.vectors * along_axes);
}

int anchor_near(const std::vector<Anchor>& anchors, const Float3& t) {
  for (std::size_t k = 0; k < anchors.size(); ++k)
    if ((t - anchors[k].at).squared_norm() < anchors[k].squared_radius) return static_cast<int>(k);
  return -1;
}

}  // namespace

ClimbEnd climb(const CandidateList& candidates, const std::vector<Anchor>& anchors, const ClimbRules& rules, Float3& t,
               int& steps, int& captured_by, std::vector<Float3>* path) {
  const auto arrived = [&] {
    if (path != nullptr) path->push_back(t);
    if (rules.capture) captured_by = anchor_near(anchors, t);
    return captured_by >= 0;
  };
  captured_by = -1;
  for (bool slow = false; !slow; ++steps) {
    if (steps >= rules.max_steps) return ClimbEnd::exhausted;
    const Shift s = candidates.shift(t, rules.squared_cutoff);
    t = t + s.step;  // eq. 1
    if (arrived()) return ClimbEnd::captured;
    if (!inside(t, rules.outer)) return ++steps, ClimbEnd::left_box;
    const float squared = s.step.squared_norm();
    if (!rules.accelerate && squared < rules.tolerance * rules.tolerance) return ClimbEnd::converged;
    slow = rules.accelerate && squared < kSlowShift * kSlowShift;
  }

  if (!inside(t, rules.inner)) return ClimbEnd::left_box;
  ShiftAndCovariance here = candidates.shift_and_covariance(t, rules.squared_cutoff);
  for (; steps < rules.max_steps; ++steps) {
    const Float3 step = fast_step(here);
    if (step.squared_norm() < kGoal * kGoal || here.shift.step.squared_norm() < kFlatGoal * kFlatGoal)
      return ClimbEnd::converged;
    Float3 next = t + step;
    ShiftAndCovariance there = candidates.shift_and_covariance(next, rules.squared_cutoff);
    if (there.density < here.density * (1.0F - kRounding)) {
      next = t + here.shift.step;
      there = candidates.shift_and_covariance(next, rules.squared_cutoff);
    }
    t = next;
    here = there;
    if (arrived()) return ClimbEnd::captured;
    if (!inside(t, rules.inner)) return ++steps, ClimbEnd::left_box;
  }
  return ClimbEnd::exhausted;
}

}  // namespace scanbench::merge
