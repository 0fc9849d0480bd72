// The Fisher information of range readings about a line. The beam at phi reads the wall (rho, alpha) at
// r = rho / cos(phi - alpha), with the sensor's own Gaussian noise along the beam.
#include "metrics/line_bound.hpp"

#include <Eigen/LU>

namespace scanbench::metrics {

std::optional<Eigen::Matrix2d> line_bound(const Scan& scan, const TrueLine& truth) {
  const PolarLine line = line_through(truth.segment.a, truth.segment.b);
  const Vec2 normal = line.normal();
  const Vec2 along = perpendicular(normal);
  const SensorNoise& noise = scan.sensor.noise;
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  for (int i = truth.first_beam; i <= truth.last_beam; ++i) {
    if (!scan.valid(i)) continue;
    const Vec2& beam = scan.sensor.geometry.direction(i);
    const double c = normal.dot(beam);  // cos(phi - alpha)
    const double s = along.dot(beam);   // sin(phi - alpha)
    if (!(c > 0)) continue;             // a wall through the sensor: its readings do not depend on its distance
    const double range = line.rho / c;
    const double sigma = noise.range_sigma(range);
    // A beam whose direction is wrong by d reads a range that is wrong by dr/dphi d.
    const double swing = range * (s / c) * noise.bearing_sigma_rad;
    const double variance = sigma * sigma + swing * swing;
    if (!(variance > 0)) return std::nullopt;
    const Eigen::Vector2d gradient(1.0 / c, -line.rho * s / (c * c));
    information += gradient * gradient.transpose() / variance;
  }
  const double determinant = information.determinant();
  if (!(determinant > 1e-12 * information(0, 0) * information(1, 1))) return std::nullopt;
  // A change of (d rho, d alpha) moves the line by d rho - t d alpha at the point t along it.
  Eigen::Matrix2d at_midpoint;
  at_midpoint << 1.0, -along.dot(truth.segment.midpoint()), 0.0, 1.0;
  return at_midpoint * information.inverse() * at_midpoint.transpose();
}

}  // namespace scanbench::metrics
