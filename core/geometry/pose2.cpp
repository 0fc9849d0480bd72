// Composition, inverse, exponential and logarithm of planar rigid motions.
#include "core/geometry/pose2.hpp"

#include <cmath>

#include "core/geometry/portable_math.hpp"

namespace scanbench {

Pose2::Pose2(const Vec2& translation, double yaw_rad) : translation_(translation) {
  const auto [s, c] = portable::sincos(yaw_rad);
  rotation_ = {c, s};
}

Pose2 Pose2::facing(const Vec2& translation, const Vec2& direction) {
  Pose2 pose;
  pose.rotation_ = direction / std::sqrt(direction.squaredNorm());
  pose.translation_ = translation;
  return pose;
}

Pose2 Pose2::from_unit(const Vec2& translation, const Vec2& rotation) {
  Pose2 pose;
  pose.rotation_ = rotation;
  pose.translation_ = translation;
  return pose;
}

double Pose2::yaw() const {
  return portable::atan2(rotation_.y(), rotation_.x());
}

Pose2 Pose2::operator*(const Pose2& other) const {
  Pose2 product;
  const Vec2 r = rotate(other.rotation_);
  product.rotation_ = r * (1.5 - 0.5 * r.squaredNorm());  // one Newton step keeps long chains on the unit circle
  product.translation_ = *this * other.translation_;
  return product;
}

Pose2 Pose2::inverse() const {
  Pose2 inverse;
  inverse.rotation_ = {rotation_.x(), -rotation_.y()};
  inverse.translation_ = -inverse.rotate(translation_);
  return inverse;
}

namespace {

// sin(w)/w and (1 - cos(w))/w, by series where the quotients lose digits.
struct ArcFactors {
  double a;
  double b;
};

ArcFactors arc_factors(double w) {
  if (std::fabs(w) < 1e-4) return {1.0 - w * w / 6.0, w / 2.0 - w * w * w / 24.0};
  const auto [s, c] = portable::sincos(w);
  return {s / w, (1.0 - c) / w};
}

}  // namespace

Pose2 Pose2::exp(const Eigen::Vector3d& twist) {
  const auto [a, b] = arc_factors(twist.z());
  return {Vec2(a * twist.x() - b * twist.y(), b * twist.x() + a * twist.y()), twist.z()};
}

Eigen::Vector3d Pose2::log() const {
  const double w = yaw();
  const auto [a, b] = arc_factors(w);
  const double n = a * a + b * b;
  return {(a * translation_.x() + b * translation_.y()) / n, (a * translation_.y() - b * translation_.x()) / n, w};
}

PolarLine transform(const Pose2& b_from_a, const PolarLine& line) {
  const Vec2 n = b_from_a.rotate(line.normal());
  return canonical(line.rho + n.dot(b_from_a.translation()), portable::atan2(n.y(), n.x()));
}

}  // namespace scanbench
