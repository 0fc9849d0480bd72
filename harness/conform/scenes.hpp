// Scans for checks of modules: sensors without a noise model, walls cast by brute force, and noise with its own seed.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/index.hpp"
#include "core/rng.hpp"
#include "core/scan.hpp"
#include "core/special_values.hpp"

namespace scanbench::conform {

/// A scan that owns its sensor and ranges. ids[i] is the wall that beam i hit, -1 for none; empty unless cast() made
/// the scan.
struct OwnedScan {
  SensorModel sensor;
  std::vector<double> ranges;
  std::vector<int> ids;

  Scan view() const { return {sensor, ranges, 0.0}; }
};

/// Beams spread evenly, first and last at the ends of the field of view (radians) about the x axis.
inline SensorModel fan_sensor(int beams, double field_of_view_rad) {
  SensorModel sensor;
  sensor.name = "fan";
  sensor.geometry = ScanGeometry(-field_of_view_rad / 2, beams > 1 ? field_of_view_rad / (beams - 1) : 0.0, beams);
  return sensor;
}

/// A full turn from -pi, the last beam one step before the first.
inline SensorModel ring_sensor(int beams, double angle_min_rad = -kPi) {
  SensorModel sensor;
  sensor.name = "ring";
  sensor.geometry = ScanGeometry(angle_min_rad, kTwoPi / beams, beams);
  return sensor;
}

/// The sides of a closed polygon.
inline std::vector<Segment> polygon(const std::vector<Vec2>& corners) {
  std::vector<Segment> sides;
  for (std::size_t i = 0; i < corners.size(); ++i) sides.push_back({corners[i], corners[(i + 1) % corners.size()]});
  return sides;
}

/// An axis-parallel box as four walls, counter-clockwise: free space inside.
inline std::vector<Segment> box(double x0, double y0, double x1, double y1) {
  return polygon({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}

/// Every beam against every wall: the nearest intersection, +inf where there is none. Noise-free.
inline OwnedScan cast(const SensorModel& sensor, const std::vector<Segment>& walls,
                      const Pose2& world_from_sensor = {}) {
  OwnedScan scan{sensor, {}, {}};
  const Vec2 o = world_from_sensor.translation();
  for (int i = 0; i < sensor.geometry.beams(); ++i) {
    const Vec2 u = world_from_sensor.rotate(sensor.geometry.direction(i));
    double nearest = kInf;
    int id = -1;
    for (std::size_t w = 0; w < walls.size(); ++w) {
      const Vec2 d = walls[w].b - walls[w].a;
      const double det = cross(u, d);
      if (det == 0) continue;
      const Vec2 to = walls[w].a - o;
      const double t = cross(to, d) / det;
      const double s = cross(to, u) / det;
      if (t > 1e-9 && s >= 0 && s <= 1 && t < nearest) {
        nearest = t;
        id = static_cast<int>(w);
      }
    }
    scan.ranges.push_back(nearest);
    scan.ids.push_back(id);
  }
  return scan;
}

/// Adds Gaussian noise along the beam, drawn per (seed, frame, beam), and states it in the sensor's model. Beams
/// without a return stay without one; a range that would become negative is a fault (NaN).
inline OwnedScan with_noise(OwnedScan scan, double sigma_m, std::uint64_t seed, std::uint32_t frame = 0) {
  scan.sensor.noise.sigma_m = sigma_m;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    if (!std::isfinite(scan.ranges[i])) continue;
    CounterRng rng(seed, RngStream::range, frame, static_cast<std::uint32_t>(i));
    scan.ranges[i] += sigma_m * rng.normal();
    if (!(scan.ranges[i] > 0)) scan.ranges[i] = kNaN;
  }
  return scan;
}

/// The same range for every beam.
inline OwnedScan constant_scan(const SensorModel& sensor, double range) {
  return {sensor, std::vector<double>(as_index(sensor.geometry.beams()), range), {}};
}

/// A random room: a box about the sensor with smaller boxes inside, none of which contains the sensor. The sensor
/// is at the origin.
inline std::vector<Segment> random_room(std::uint64_t seed) {
  CounterRng rng(seed, RngStream::pose);
  const auto between = [&](double low, double high) { return low + (high - low) * rng.uniform(); };
  std::vector<Segment> walls = box(between(-6, -2), between(-6, -2), between(2, 6), between(2, 6));
  for (int k = 0; k < 3; ++k) {
    const double angle = between(-kPi, kPi);
    const Vec2 centre = between(1.2, 2.5) * Vec2(std::cos(angle), std::sin(angle));
    const double turn = between(0, kPi);
    const double size = between(0.2, 0.5);
    std::vector<Vec2> corners;
    for (int c = 0; c < 4; ++c)
      corners.emplace_back(centre + size * Vec2(std::cos(turn + c * kPi / 2), std::sin(turn + c * kPi / 2)));
    for (const Segment& s : polygon(corners)) walls.push_back(s);
  }
  return walls;
}

/// The same scene rotated about the sensor by `angle`: only the sensor's start angle changes.
inline OwnedScan turned(const OwnedScan& scan, double angle) {
  OwnedScan result = scan;
  const ScanGeometry& g = scan.sensor.geometry;
  result.sensor.geometry = ScanGeometry(g.angle_min() + angle, g.angle_step(), g.beams());
  return result;
}

}  // namespace scanbench::conform
