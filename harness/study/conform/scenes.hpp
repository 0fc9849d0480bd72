// Scans for checks of modules: sensors without a noise model, walls cast by brute force, and noise with its own seed.
#pragma once

#include <cmath>
#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/index.hpp"
#include "core/modules.hpp"
#include "core/rng.hpp"
#include "core/scan.hpp"
#include "core/special_values.hpp"

namespace scanbench::study::conform {

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
  const Vec2& o = world_from_sensor.translation();
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
    corners.reserve(4);
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

/// One line from the first to the last point of each run of beams that hit the same wall.
inline ScanLines lines_of(const OwnedScan& scan) {
  ScanLines result{{}, std::vector<int>(scan.ranges.size(), -1)};
  const Scan view = scan.view();
  for (std::size_t i = 0; i < scan.ids.size();) {
    std::size_t end = i + 1;
    while (end < scan.ids.size() && scan.ids[end] == scan.ids[i]) ++end;
    const int first = static_cast<int>(i), last = static_cast<int>(end) - 1;
    if (scan.ids[i] >= 0 && last > first && view.valid(first) && view.valid(last)) {
      LineFeature line;
      line.segment = {view.point(first), view.point(last)};
      line.line = line_through(line.segment.a, line.segment.b);
      line.first_beam = first;
      line.last_beam = last;
      for (std::size_t k = i; k < end; ++k)
        if (view.valid(static_cast<int>(k))) {
          result.labels[k] = static_cast<int>(result.lines.size());
          ++line.points;
        }
      result.lines.push_back(line);
    }
    i = end;
  }
  return result;
}

/// Scans with their lines, which it owns.
class Series {
 public:
  void add(OwnedScan scan) {
    ScanLines lines = lines_of(scan);
    held_.emplace_back(std::move(scan), std::move(lines));
  }
  std::vector<Observation> observations() const {
    std::vector<Observation> result;
    for (const Held& h : held_) result.push_back({h.view, h.lines});
    return result;
  }
  std::size_t size() const { return held_.size(); }
  const OwnedScan& scan(std::size_t k) const { return held_[k].scan; }

 private:
  struct Held {
    Held(OwnedScan s, ScanLines l) : scan(std::move(s)), view(scan.view()), lines(std::move(l)) {}
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;
    ~Held() = default;
    OwnedScan scan;
    Scan view;
    ScanLines lines;
  };
  std::deque<Held> held_;
};

/// Stops of a sensor on an arc through a room.
inline Pose2 stop(int k) {
  return {0.15 * k - 1.0, 0.05 * k, 0.08 * k};
}

/// Scans of a room from the first stops, with noise of 1 cm.
inline Series drive(int scans) {
  Series series;
  for (int k = 0; k < scans; ++k)
    series.add(
        with_noise(cast(ring_sensor(361), box(-4, -3, 5, 3.5), stop(k)), 0.01, 5, static_cast<std::uint32_t>(k)));
  return series;
}

/// The poses of the first stops, all moved.
inline std::vector<Pose2> stops(int scans, const Pose2& motion = {}) {
  std::vector<Pose2> poses;
  poses.reserve(static_cast<std::size_t>(scans));
  for (int k = 0; k < scans; ++k) poses.push_back(motion * stop(k));
  return poses;
}

inline bool is_near(const Segment& a, const Segment& b, double tolerance) {
  return (a.a - b.a).norm() <= tolerance && (a.b - b.b).norm() <= tolerance;
}

/// A trace that takes everything, which must not change a result.
inline Trace listening_trace() {
  return Trace({.stage = [](Stage) {}, .row = [](const TraceSchema&, std::span<const double>) {}});
}

}  // namespace scanbench::study::conform
