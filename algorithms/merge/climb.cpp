// One climb of mean shift inside one box (Lakaemper 2009, eq. 1), in float.
#include "algorithms/merge/climb.hpp"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace scanbench::merge {
namespace {

constexpr double kCurvatureFloor = 0.02;  // flatter places are left to the double iteration
constexpr double kLongestNewton = 0.3;
constexpr double kNewtonGoal = 1e-5;
constexpr int kNewtonSteps = 6;

Float3 operator+(const Float3& a, const Float3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Float3 operator-(const Float3& a, const Float3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

bool inside(const Float3& t, const Float3& box) {
  return std::abs(t.x) <= box.x && std::abs(t.y) <= box.y && std::abs(t.z) <= box.z;
}

/// Newton on the log density where it is safely concave. True: t is the end of the climb to kNewtonGoal; t stays what
/// it was otherwise.
bool newton_finish(const CandidateList& candidates, const ClimbRules& rules, Float3& t) {
  Float3 at = t;
  double last = kLongestNewton;
  for (int k = 0; k < kNewtonSteps; ++k) {
    const ShiftAndCovariance s = candidates.shift_and_covariance(at, rules.squared_cutoff);
    Eigen::Matrix3d a;  // minus the Hessian of the log density
    a << 1.0 - double{s.xx}, -double{s.xy}, -double{s.xz}, -double{s.xy}, 1.0 - double{s.yy}, -double{s.yz},
        -double{s.xz}, -double{s.yz}, 1.0 - double{s.zz};
    const Eigen::LLT<Eigen::Matrix3d> cholesky(a - kCurvatureFloor * Eigen::Matrix3d::Identity());
    if (cholesky.info() != Eigen::Success) return false;
    const Eigen::Vector3d step = a.llt().solve(Eigen::Vector3d(s.shift.step.x, s.shift.step.y, s.shift.step.z));
    const double length = step.norm();
    if (!(length <= last)) return false;
    last = length;
    at = at + Float3{static_cast<float>(step.x()), static_cast<float>(step.y()), static_cast<float>(step.z())};
    if (!inside(at, rules.box)) return false;
    if (length < kNewtonGoal) {
      t = at;
      return true;
    }
  }
  return false;
}

int anchor_near(const std::vector<Anchor>& anchors, const Float3& t) {
  for (std::size_t k = 0; k < anchors.size(); ++k)
    if ((t - anchors[k].at).squared_norm() < anchors[k].squared_radius) return static_cast<int>(k);
  return -1;
}

}  // namespace

ClimbEnd climb(const CandidateList& candidates, const std::vector<Anchor>& anchors, const ClimbRules& rules, Float3& t,
               int& steps, int& captured_by, std::vector<Float3>* path) {
  float tolerance = rules.tolerance;
  const float smallest_tolerance = 0.1F * rules.tolerance;
  for (; steps < rules.max_steps; ++steps) {
    const Shift s = candidates.shift(t, rules.squared_cutoff);
    t = t + s.step;  // eq. 1
    if (path != nullptr) path->push_back(t);
    if (!inside(t, rules.box)) {
      ++steps;
      return ClimbEnd::left_box;
    }
    if (rules.capture) {
      captured_by = anchor_near(anchors, t);
      if (captured_by >= 0) return ClimbEnd::captured;
    }
    const float squared = s.step.squared_norm();
    if (squared < tolerance * tolerance) {
      if (newton_finish(candidates, rules, t)) return ClimbEnd::converged;
      if (tolerance <= smallest_tolerance) return ClimbEnd::converged;  // a plateau: on from here in double
      tolerance *= 0.5F;
    }
  }
  return ClimbEnd::exhausted;
}

}  // namespace scanbench::merge
