// Safeguarded Newton iteration to a mode of a Gaussian kernel density.
#include "algorithms/merge/mean_shift/mode_polish.hpp"

#include "core/geometry/symmetric_matrix.hpp"

namespace scanbench::merge {
namespace {

constexpr double kPolishGradientGoal = 1e-10;
constexpr double kGradientFlat = 1e-6;          // with a smaller gradient, a place that is not a maximum is a saddle
constexpr double kNewtonCurvatureFloor = 1e-4;  // Newton's divisor on plateaus, where the curvature is rounding errors
constexpr double kLongestStep = 0.5;
constexpr double kSaddleStep = 0.01;
constexpr int kMaxSteps = 200;

struct Density {
  double mass = 0.0;
  Vec3 shift = Vec3::Zero();  // the gradient of the log density
  Eigen::Matrix3d minus_hessian = Eigen::Matrix3d::Identity();
};

Density density_at(const Vec3& t, double period, const std::vector<Vec3>& differences) {
  double m = 0, sx = 0, sy = 0, sz = 0, xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  for (const Vec3& p : differences) {
    const double dx = p.x() - t.x();
    const double dy = p.y() - t.y();
    const double dz = wrapped(p.z() - t.z(), period);
    const double squared = dx * dx + dy * dy + dz * dz;
    if (squared > kPolishCutoff * kPolishCutoff) continue;
    const double w = std::exp(-0.5 * squared);
    m += w;
    sx += w * dx;
    sy += w * dy;
    sz += w * dz;
    xx += w * dx * dx;
    xy += w * dx * dy;
    xz += w * dx * dz;
    yy += w * dy * dy;
    yz += w * dy * dz;
    zz += w * dz * dz;
  }
  Density d;
  d.mass = m;
  if (!(m > 0)) return d;
  d.shift = Vec3(sx, sy, sz) / m;
  Eigen::Matrix3d second;
  second << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  d.minus_hessian = Eigen::Matrix3d::Identity() - (second / m - d.shift * d.shift.transpose());
  return d;
}

/// Newton's step with the absolute values of the curvatures, at most kLongestStep long: uphill for any Hessian.
Vec3 ascent_step(const SymmetricEigen<Eigen::Matrix3d>& eigen, const Vec3& gradient) {
  Vec3 step = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis = eigen.vectors.col(k);
    step += axis * (axis.dot(gradient) / std::max(std::abs(eigen.values[k]), kNewtonCurvatureFloor));
  }
  const double length = step.norm();
  return length > kLongestStep ? Vec3(step * (kLongestStep / length)) : step;
}

}  // namespace

PolishedMode polish_mode(const Vec3& start, double period, const Neighbours& neighbours) {
  std::vector<Vec3> differences;
  Vec3 centre = start;
  Vec3 t = Vec3::Zero();  // relative to the centre
  neighbours(centre, differences);
  Density here = density_at(t, period, differences);
  double curvature = 1.0;
  for (int step_count = 0; step_count < kMaxSteps; ++step_count) {
    const double gradient = here.shift.norm();
    const SymmetricEigen<Eigen::Matrix3d> eigen = symmetric_eigen(here.minus_hessian);
    curvature = eigen.values[0];
    const bool saddle = curvature < -kNewtonCurvatureFloor;
    if (gradient <= kPolishGradientGoal && !saddle) break;

    Vec3 step = ascent_step(eigen, here.shift);
    if (gradient <= kGradientFlat && saddle) {
      // Leaves the saddle along the direction in which the density is convex, which is uphill on both sides.
      Vec3 axis = eigen.vectors.col(0);
      if (axis.dot(here.shift) < 0) axis = -axis;
      step = kSaddleStep * axis;
    }
    Density there = density_at(t + step, period, differences);
    // Near the mode rounding hides the increase of the density; there the gradient must decrease instead.
    const auto better = [&](const Density& d) {
      return d.mass > here.mass || (d.mass > here.mass * (1 - 1e-14) && d.shift.norm() < gradient);
    };
    for (int halving = 0; halving < 4 && !better(there); ++halving) {
      step *= 0.5;
      there = density_at(t + step, period, differences);
    }
    if (!better(there)) {
      step = here.shift;  // eq. 1: never downhill
      there = density_at(t + step, period, differences);
      if (!better(there)) break;
    }
    t += step;
    here = there;
    if (t.cwiseAbs().maxCoeff() > kPolishBox) {
      centre += t;
      centre.z() = reduced(centre.z(), period);
      t.setZero();
      neighbours(centre, differences);
      here = density_at(t, period, differences);
    }
  }
  Vec3 position = centre + t;
  position.z() = reduced(position.z(), period);
  return {position, here.shift.norm(), curvature};
}

}  // namespace scanbench::merge
