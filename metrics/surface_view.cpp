// Sums of the information of beams per surface.
#include "metrics/surface_view.hpp"

#include <algorithm>

#include "metrics/line_bound.hpp"

namespace scanbench::metrics {

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
