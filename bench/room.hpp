// The room that the benchmarks of single extractors scan. It is 12 m x 9 m with two boxes. Scans cover 270 degrees,
// from positions 0.5 m to 2.5 m from the left wall with random headings, with Gaussian noise along the beam.
#pragma once

#include <algorithm>
#include <vector>

#include "core/rng.hpp"
#include "core/scan.hpp"
#include "core/special_values.hpp"

namespace scanbench::bench {

/// Range from `origin` to the nearest wall in direction d.
inline double range_in_room(const Vec2& origin, const Vec2& d) {
  static constexpr double kBoxes[][4] = {{0, 0, 12, 9}, {3, 2, 4, 3.5}, {8, 5, 10, 6}};
  double best = kInf;
  for (const auto& b : kBoxes)
    for (int axis = 0; axis < 2; ++axis)
      for (int side = 0; side < 2; ++side) {
        const double t = (b[axis + 2 * side] - origin[axis]) / d[axis];
        const double across = origin[1 - axis] + t * d[1 - axis];
        if (t > 0 && across >= b[1 - axis] && across <= b[3 - axis]) best = std::min(best, t);
      }
  return best;
}

/// `count` scans of the room, each from a different pose.
inline ScanSet room_scans(int beams, double sigma_m, std::uint32_t count) {
  ScanSet set;
  set.sensor.geometry = ScanGeometry(radians(-135), radians(270.0 / (beams - 1)), beams);
  set.sensor.noise.sigma_m = sigma_m;
  set.frames.resize(count);
  for (std::uint32_t k = 0; k < count; ++k) {
    CounterRng place(1, RngStream::pose, k);
    const Vec2 origin(0.5 + 2 * place.uniform(), 0.5 + 8 * place.uniform());
    const double yaw = kTwoPi * place.uniform();
    for (int i = 0; i < beams; ++i) {
      const double a = yaw + set.sensor.geometry.angle(i);
      CounterRng noise(1, RngStream::range, k, static_cast<std::uint32_t>(i));
      set.frames[k].ranges.push_back(range_in_room(origin, {std::cos(a), std::sin(a)}) + sigma_m * noise.normal());
    }
  }
  return set;
}

}  // namespace scanbench::bench
