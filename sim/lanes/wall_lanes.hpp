// Ranges to walls in lanes: one wall and several beams, or one ray and several walls. The same operations in the same
// order as range_to_wall() of sim/ray_math.hpp, hence the same bits.
#pragma once

#include "core/lanes/lanes.hpp"
#include "sim/wall_range.hpp"

namespace scanbench::sim::SCANBENCH_ISA {

/// Surfaces closer together than this along a ray count as equally near; the lowest index wins.
inline constexpr double kTie = 1e-9;

/// Computes the lanes one by one, if a ray passes close to an end of its wall.
[[gnu::noinline, gnu::cold]] inline Doubles wall_range_one_by_one(Doubles ax, Doubles ay, Doubles bx, Doubles by,
                                                                  Doubles dx, Doubles dy) {
  Doubles range;
  for (int i = 0; i < kLanes; ++i) range[i] = range_along_wall(ax[i], ay[i], bx[i], by[i], dx[i], dy[i]);
  return range;
}

/// `a`, `b`: ends relative to the ray's origin; `d`: unit direction. +inf without a hit.
inline Doubles exact_wall_range(Doubles ax, Doubles ay, Doubles bx, Doubles by, Doubles dx, Doubles dy) {
  const Doubles side_a = dx * ay - dy * ax;
  const Doubles side_b = dx * by - dy * bx;
  if (mask_bits(min(abs(side_a), abs(side_b)) <= kEndToleranceM) != 0) [[unlikely]]
    return wall_range_one_by_one(ax, ay, bx, by, dx, dy);
  const Doubles along_a = dx * ax + dy * ay;
  const Doubles along_b = dx * bx + dy * by;
  const Doubles share = side_a / (side_a - side_b);
  const Doubles along = along_a + share * (along_b - along_a);
  const Longs hit = opposite(side_a, side_b) & (along >= -kEndToleranceM);
  return hit ? max(all(0.0), along) : all(kNoHit);
}

/// The nearest surface per lane: smallest range, and of those within kTie the lowest index.
struct NearestLanes {
  Doubles range;
  Doubles surface;

  void offer(Doubles r, Doubles s) {
    const Longs tied = (r <= range + kTie) & (r < kNoHit);
    surface = (r < range - kTie) ? s : (tied ? min(surface, s) : surface);
    range = min(r, range);
  }
};

}  // namespace scanbench::sim::SCANBENCH_ISA
