// The Fisher information of range readings about a line. The beam at phi reads the wall (rho, alpha) at
// r = rho / cos(phi - alpha), with the sensor's own Gaussian noise along the beam.
#include "metrics/line_bound.hpp"

#include <algorithm>

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

std::map<int, SurfaceView> views_of(const MetricInput& input, const Surfaces& surfaces, std::size_t frame) {
  const Truth& truth = *input.truth;
  const Scan scan = input.observed.scan(frame);
  const Pose2 sensor_from_world = truth.world_from_sensor[frame].inverse();
  std::map<int, SurfaceView> views;
  for (int i = 0; i < scan.beams(); ++i) {
    const std::size_t at = frame * static_cast<std::size_t>(scan.beams()) + static_cast<std::size_t>(i);
    if (truth.wall_ids[at] < 0 || !scan.valid(i)) continue;
    const int surface = surfaces.of_wall[static_cast<std::size_t>(truth.wall_ids[at])];
    SurfaceView& view = views[surface];
    if (view.beams == 0) {
      const Segment& wall = surfaces.segments[static_cast<std::size_t>(surface)];
      view.line = line_through(sensor_from_world * wall.a, sensor_from_world * wall.b);
    }
    const auto information = beam_information(scan.sensor, i, view.line);
    if (!information) continue;
    view.information += *information;
    view.middle += truth.ranges[at] * scan.sensor.geometry.direction(i);
    ++view.beams;
  }
  for (auto& [surface, view] : views) view.middle /= std::max(view.beams, 1);
  return views;
}

Eigen::Matrix2d information_at(const SurfaceView& view, const Vec2& point, const Vec2& normal) {
  // A change of (d rho, d alpha) moves the line by d rho - t d alpha at the point t along it.
  const Vec2 own = view.line.normal();
  const double side = own.dot(normal) < 0 ? -1.0 : 1.0;
  Eigen::Matrix2d polar_from_local;
  polar_from_local << side, perpendicular(own).dot(point), 0.0, 1.0;
  return polar_from_local.transpose() * view.information * polar_from_local;
}

}  // namespace scanbench::metrics
