// Ranges to walls in lanes: one wall and several beams, or one ray and several walls. The same operations in the same
// order as range_to_wall() of sim/ray_math.hpp, hence the same bits.
#pragma once

#include "sim/lanes/lanes.hpp"
#include "sim/wall_range.hpp"

namespace scanbench::sim::SCANBENCH_ISA {

/// Surfaces closer together than this along a ray count as equally near; the lowest index wins.
inline constexpr double kTie = 1e-9;

/// Computes the lanes one by one, if a ray passes close to an end of its wall.
template <class D>
[[gnu::noinline, gnu::cold]] inline D wall_range_one_by_one(D ax, D ay, D bx, D by, D dx, D dy) {
  D range;
  for (int i = 0; i < static_cast<int>(sizeof(D) / sizeof(double)); ++i)
    range[i] = range_along_wall(ax[i], ay[i], bx[i], by[i], dx[i], dy[i]);
  return range;
}

/// `a`, `b`: ends relative to the ray's origin; `d`: unit direction. +inf without a hit.
template <class D>
inline D exact_wall_range(D ax, D ay, D bx, D by, D dx, D dy) {
  const D side_a = dx * ay - dy * ax;
  const D side_b = dx * by - dy * bx;
  if (mask_bits(min(abs(side_a), abs(side_b)) <= kEndToleranceM) != 0) [[unlikely]]
    return wall_range_one_by_one(ax, ay, bx, by, dx, dy);
  const D along_a = dx * ax + dy * ay;
  const D along_b = dx * bx + dy * by;
  const D share = side_a / (side_a - side_b);
  const D along = along_a + share * (along_b - along_a);
  const auto hit = opposite(side_a, side_b) & (along >= -kEndToleranceM);
  return hit ? max(every<D>(0.0), along) : every<D>(kNoHit);
}

/// The nearest surface per lane: smallest range, and of those within kTie the lowest index.
template <class D>
struct NearestLanes {
  D range;
  D surface;

  void offer(D r, D s) {
    const auto tied = (r <= range + kTie) & (r < kNoHit);
    surface = (r < range - kTie) ? s : (tied ? min(surface, s) : surface);
    range = min(r, range);
  }
};

}  // namespace scanbench::sim::SCANBENCH_ISA
