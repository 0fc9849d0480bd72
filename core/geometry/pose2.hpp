// Rigid motions of the plane, named b_from_a so that composition cancels by eye: world_from_sensor * p_in_sensor.
#pragma once

#include "core/geometry/geometry.hpp"

namespace scanbench {

/// A rotation (unit complex number) and a translation in metres. Value type; identity by default.
class Pose2 {
 public:
  Pose2() = default;
  Pose2(const Vec2& translation, double yaw_rad);
  Pose2(double x_m, double y_m, double yaw_rad) : Pose2(Vec2(x_m, y_m), yaw_rad) {}
  /// The pose with its heading along `direction`, which must not be zero. Exact: no angle is computed.
  static Pose2 facing(const Vec2& translation, const Vec2& direction);
  /// The pose whose (cos, sin) are `rotation` to the last bit: for reading back what cos() and sin() returned.
  static Pose2 from_unit(const Vec2& translation, const Vec2& rotation);

  const Vec2& translation() const { return translation_; }
  double x() const { return translation_.x(); }
  double y() const { return translation_.y(); }
  double cos() const { return rotation_.x(); }
  double sin() const { return rotation_.y(); }
  double yaw() const;  ///< in (-pi, pi]

  Vec2 rotate(const Vec2& v) const {
    return {rotation_.x() * v.x() - rotation_.y() * v.y(), rotation_.y() * v.x() + rotation_.x() * v.y()};
  }
  Vec2 operator*(const Vec2& p) const { return rotate(p) + translation_; }
  Segment operator*(const Segment& s) const { return {*this * s.a, *this * s.b}; }
  Pose2 operator*(const Pose2& other) const;
  Pose2 inverse() const;

  /// The motion of a constant twist (vx, vy, omega) over unit time, and back. log(exp(t)) = t for |omega| < pi.
  static Pose2 exp(const Eigen::Vector3d& twist);
  Eigen::Vector3d log() const;

  bool operator==(const Pose2&) const = default;

 private:
  Vec2 rotation_{1.0, 0.0};
  Vec2 translation_{0.0, 0.0};
};

/// A line given in frame a, expressed in frame b.
PolarLine transform(const Pose2& b_from_a, const PolarLine& line);

}  // namespace scanbench
