// Recording of the tests of figures: walls, scans by brute force, and lines by wall.
#include "abcdef.hpp"

#include <array>
#include <cmath>

#include "core/rng.hpp"

namespace scanbench::render::test {

NamedPoints abcdef_waypoints() {
  return {{"A", {6.45, 3.15}}, {"B", {4.60, 1.50}}, {"C", {2.30, 8.15}},
          {"D", {7.25, 6.00}}, {"E", {5.10, 7.45}}, {"F", {1.35, 7.70}}};
}

Recording abcdef_recording(int frames) {
  constexpr std::array<std::array<double, 4>, 15> kWalls{{{1.55, 0.75, 1.55, 1.65},
                                                          {1.95, 2.20, 2.45, 3.25},
                                                          {1.25, 11.25, 1.80, 11.25},
                                                          {1.55, 0.75, 1.55, 3.90},
                                                          {2.75, 0.00, 2.75, 0.45},
                                                          {9.75, 7.45, 9.75, 11.40},
                                                          {2.70, 10.00, 3.35, 10.00},
                                                          {0.00, 2.35, 0.00, 5.90},
                                                          {2.85, 5.15, 1.55, 3.75},
                                                          {11.15, 13.35, 13.50, 13.35},
                                                          {9.70, 7.40, 10.35, 7.40},
                                                          {1.90, 10.90, 2.50, 10.90},
                                                          {1.55, 10.90, 5.90, 10.90},
                                                          {3.20, 0.95, 3.20, 2.05},
                                                          {3.30, 9.90, 4.05, 9.70}}};
  Truth truth;
  for (const auto& [x1, y1, x2, y2] : kWalls)
    truth.walls.push_back({std::to_string(truth.walls.size() + 1), {{x1, y1}, {x2, y2}}});

  const NamedPoints way = abcdef_waypoints();
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) length += (way[i + 1].second - way[i].second).norm();
  for (int f = 0; f < frames; ++f) {
    double s = length * (f + 0.5) / frames;
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
      const Vec2 leg = way[i + 1].second - way[i].second;
      if (s <= leg.norm() || i + 2 == way.size()) {
        truth.world_from_sensor.push_back(Pose2::facing(way[i].second + leg * (s / leg.norm()), leg));
        break;
      }
      s -= leg.norm();
    }
  }

  Recording recording;
  recording.observed.sensor.geometry = ScanGeometry(radians(-135), radians(0.6), 451);
  for (std::size_t f = 0; f < truth.world_from_sensor.size(); ++f) {
    Frame frame{0.1 * static_cast<double>(f), {}, truth.world_from_sensor[f]};
    for (int beam = 0; beam < 451; ++beam) {
      const Vec2 o = frame.odom_from_sensor.translation();
      const Vec2 d = frame.odom_from_sensor.rotate(recording.observed.sensor.geometry.direction(beam));
      double range = INFINITY;
      int id = -1;
      for (std::size_t w = 0; w < truth.walls.size(); ++w) {
        const Vec2 a = truth.walls[w].segment.a, e = truth.walls[w].segment.b - a;
        const double det = cross(d, e), t = cross(a - o, e) / det, u = cross(a - o, d) / det;
        if (t > 0 && u >= 0 && u <= 1 && t < range) range = t, id = static_cast<int>(w);
      }
      CounterRng rng(1, RngStream::range, static_cast<std::uint32_t>(f), static_cast<std::uint32_t>(beam));
      truth.ranges.push_back(range);
      truth.wall_ids.push_back(id);
      frame.ranges.push_back(range + 0.05 * rng.normal());
    }
    recording.observed.frames.push_back(std::move(frame));
  }
  recording.truth = std::move(truth);
  return recording;
}

PipelineResult lines_by_wall_id(const Recording& recording, double jitter_m, bool with_map) {
  PipelineResult result;
  const Truth& truth = *recording.truth;
  for (std::size_t f = 0; f < recording.observed.frames.size(); ++f) {
    CounterRng rng(2, RngStream::resampling, static_cast<std::uint32_t>(f));
    const Scan scan = recording.observed.scan(f);
    ScanLines lines;
    lines.labels.assign(static_cast<std::size_t>(scan.beams()), -1);
    const auto id = [&](int beam) {
      return truth.wall_ids[f * static_cast<std::size_t>(scan.beams()) + static_cast<std::size_t>(beam)];
    };
    for (int first = 0, last; first < scan.beams(); first = last + 1) {
      for (last = first; last + 1 < scan.beams() && id(last + 1) == id(first);) ++last;
      if (id(first) < 0 || last - first < 4) continue;
      const Vec2 shift(jitter_m * rng.normal(), jitter_m * rng.normal());
      const auto at = [&](int beam) {
        return Vec2(truth.ranges[f * static_cast<std::size_t>(scan.beams()) + static_cast<std::size_t>(beam)] *
                        scan.sensor.geometry.direction(beam) +
                    shift);
      };
      LineFeature& line = lines.lines.emplace_back();
      line.segment = {at(first), at(last)};
      line.line = line_through(line.segment.a, line.segment.b);
      line.covariance = Eigen::Matrix2d(Eigen::Vector2d(jitter_m * jitter_m + 1e-6, 1e-4).asDiagonal());
      line.first_beam = first, line.last_beam = last;
      for (int beam = first; beam <= last; ++beam)
        lines.labels[static_cast<std::size_t>(beam)] = static_cast<int>(lines.lines.size()) - 1;
    }
    result.lines.push_back(std::move(lines));
  }
  if (with_map)
    for (const Wall& wall : truth.walls) result.map.lines.push_back({.segment = wall.segment});
  return result;
}

}  // namespace scanbench::render::test
