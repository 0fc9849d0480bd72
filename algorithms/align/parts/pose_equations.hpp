// Normal equations of a pose from readings on lines: Jacobian, weights, and the motions that they determine. Siadat et
// al. 1997, section 7 (segment-point).
#pragma once

#include <span>
#include <vector>

#include "algorithms/align/parts/line_grid.hpp"
#include "core/modules.hpp"

namespace scanbench::align {

/// A return, sensor frame.
struct Reading {
  Vec2 point;
  Vec2 surface;  ///< unit direction of the line that the return supports; zero if it supports none
};

/// The parts of a scan that are registered, in its sensor frame.
struct ScanShape {
  std::vector<Reading> readings;
  std::vector<Segment> lines;  ///< all finite and of positive length
  double lever_m = 1.0;        ///< median distance of the returns: converts radians to metres of motion
};

/// Skips points and lines beyond 1e9 m, and lines that have no length or are not finite.
ScanShape shape_of(const Observation& observation);

inline Sighting placed(const Reading& reading, const Pose2& world_from_sensor) {
  return {world_from_sensor * reading.point, world_from_sensor.translation(),
          world_from_sensor.rotate(reading.surface)};
}

/// Derivative of the oriented distance of `point` from a line with this normal, by the pose of the scan to which the
/// point belongs: by x and y of its sensor and by lever_m times its yaw. All three are in metres, so their eigenvalues
/// can be compared. The derivative by the pose of the scan to which the line belongs is the negative, with the sensor
/// and lever of that scan.
inline Eigen::Vector3d row_of(const Vec2& normal, const Vec2& point, const Vec2& sensor, double lever_m) {
  return {normal.x(), normal.y(), normal.dot(perpendicular(point - sensor)) / lever_m};
}

/// Tukey's biweight: 1 on the line and 0 at the gate, so that the sum is continuous when a point passes the gate.
inline double tukey_weight(double residual, double gate) {
  const double u = residual / gate;
  return u * u < 1.0 ? (1.0 - u * u) * (1.0 - u * u) : 0.0;
}

/// Orthonormal motions, as columns, that a normal matrix determines: its eigenvectors with an eigenvalue of at least
/// 1e-3 of the largest. Their number is the rank, which is 0 for the zero matrix.
struct Observable {
  Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 3> motions{3, 0};
  Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 3, 1> eigenvalues{0};
  int rank() const { return static_cast<int>(motions.cols()); }
};
Observable observable(const Eigen::Matrix3d& normal_matrix);

/// The distance and angle by which a pose moved.
struct Move {
  double shift_m = 0.0;
  double turn_rad = 0.0;
  bool small() const { return shift_m < 1e-4 && turn_rad < 1e-5; }
};

/// Adds a motion (x, y, lever_m * yaw) to a pose: shifts the sensor and rotates the scan about it.
Move move_by(const Eigen::Vector3d& motion, double lever_m, Pose2& world_from_sensor);

}  // namespace scanbench::align
