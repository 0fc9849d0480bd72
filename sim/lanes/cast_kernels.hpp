// Casts whole scans: sweeps every wall over the beams instead of every beam over the walls.
//
// Seen from the sensor a wall covers a run of neighbouring beams, and along a direction d its inverse range is linear:
// 1/r = (d x e) / (a x e) for a wall from a with the edge e. So the angles of its ends give the first and the last
// beam, and two multiplications tell for each group of beams whether the wall can be the nearest. If it can, the exact
// expression of sim/wall_range.hpp gives the range. Angles and inverse ranges have margins for their errors: they save
// work, but never decide.
#pragma once

#include <cstdint>

#include "sim/cast/beam_fan.hpp"
#include "sim/cast/wall_view.hpp"

namespace scanbench::sim {

struct NearestSurface {
  double range;
  double surface;  ///< index; -1: none
};

/// The kernels of casting, for one kind of processor.
struct CastKernels {
  /// Rotates a sensor's beams into the world: `count` numbers each, a multiple of 8.
  void (*rotate)(const double* x, const double* y, double cos, double sin, int count, double* out_x, double* out_y);
  /// Clears the hits; `unhit` is unhit_range(), surfaces beyond it do not count. `count` numbers, a multiple of 8.
  void (*clear)(const BeamHits& hits, int count, double unhit);
  /// Writes the results of `count` beams. Beyond `range_max` the range is +inf and the id -1. A surface with an index
  /// below `walls` is a wall, and its index the id; other surfaces get -1. An array may be null.
  void (*finish)(const BeamHits& hits, int count, double range_max, double walls, double* ranges,
                 std::int32_t* wall_ids);
  /// Offers every wall to every beam that it covers. For a few hundred walls at most.
  void (*sweep_all)(const WallView& walls, const BeamFan& fan, const BeamHits& hits);
  /// The same through the tree, nearest boxes first; boxes behind the hits so far are skipped.
  void (*sweep_tree)(const WallView& walls, const BeamFan& fan, const BeamHits& hits);
  /// Casts one ray; surfaces beyond `range_max` are ignored.
  NearestSurface (*walk)(const WallView& walls, double ox, double oy, double dx, double dy, double range_max);
};

namespace baseline {
extern const CastKernels kCastKernels;
}
namespace v3 {
extern const CastKernels kCastKernels;
}

}  // namespace scanbench::sim
