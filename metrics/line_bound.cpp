// The Fisher information of range readings about a line. The beam at phi reads the wall (rho, alpha) at
// r = rho / cos(phi - alpha), with the sensor's own Gaussian noise along the beam.
#include "metrics/line_bound.hpp"

#include <Eigen/LU>

namespace scanbench::metrics {

std::optional<Eigen::Matrix2d> beam_information(const SensorModel& sensor, int beam, const PolarLine& line) {
  const Vec2 normal = line.normal();
  const Vec2& direction = sensor.geometry.direction(beam);
  const double c = normal.dot(direction);                 // cos(phi - alpha)
  const double s = perpendicular(normal).dot(direction);  // sin(phi - alpha)
  if (!(c > 0))
    return Eigen::Matrix2d(Eigen::Matrix2d::Zero());  // a wall through the sensor: no beam says how far it is
  const double range = line.rho / c;
  const double sigma = sensor.noise.range_sigma(range);
  // A beam that points elsewhere by d reads another range by dr/dphi d.
  const double swing = range * (s / c) * sensor.noise.bearing_sigma_rad;
  const double variance = sigma * sigma + swing * swing;
  if (!(variance > 0)) return std::nullopt;
  const Eigen::Vector2d gradient(1.0 / c, -line.rho * s / (c * c));
  return Eigen::Matrix2d(gradient * gradient.transpose() / variance);
}

std::optional<Eigen::Matrix2d> line_bound(const Scan& scan, const TrueLine& truth) {
  const PolarLine line = line_through(truth.segment.a, truth.segment.b);
  const Vec2 along = perpendicular(line.normal());
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  for (int i = truth.first_beam; i <= truth.last_beam; ++i) {
    if (!scan.valid(i)) continue;
    const auto of_beam = beam_information(scan.sensor, i, line);
    if (!of_beam) return std::nullopt;
    information += *of_beam;
  }
  const double determinant = information.determinant();
  if (!(determinant > 1e-12 * information(0, 0) * information(1, 1))) return std::nullopt;
  // A change of (d rho, d alpha) moves the line by d rho - t d alpha at the point t along it.
  Eigen::Matrix2d at_midpoint;
  at_midpoint << 1.0, -along.dot(truth.segment.midpoint()), 0.0, 1.0;
  return at_midpoint * information.inverse() * at_midpoint.transpose();
}

}  // namespace scanbench::metrics
