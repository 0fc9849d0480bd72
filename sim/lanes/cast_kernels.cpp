// Sweeps walls over the beams of a scan, all of them or through the tree.
#include "sim/lanes/cast_kernels.hpp"

#include "core/lanes/lanes.hpp"
#include "sim/lanes/ray_walk.hpp"
#include "sim/lanes/wall_lanes.hpp"
#include "sim/lanes/wall_runs.hpp"

namespace scanbench::sim::SCANBENCH_ISA {
namespace {

void rotate(const double* x, const double* y, double cos, double sin, int count, double* out_x, double* out_y) {
  for (int i = 0; i < count; i += kLanes) {
    const Doubles vx = load(x + i);
    const Doubles vy = load(y + i);
    store(out_x + i, cos * vx - sin * vy);
    store(out_y + i, sin * vx + cos * vy);
  }
}

void clear(const BeamHits& hits, int count, double unhit) {
  for (int i = 0; i < count; i += kLanes) {
    store(hits.range + i, all(unhit));
    store(hits.surface + i, all(-1.0));
  }
}

void finish(const BeamHits& hits, int count, double range_max, double walls, double* ranges, std::int32_t* wall_ids) {
  int i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    const Doubles range = load(hits.range + i);
    const Doubles surface = load(hits.surface + i);
    const Longs in_reach = range <= range_max;
    if (ranges != nullptr) store(ranges + i, in_reach ? range : all(kNoHit));
    if (wall_ids != nullptr) store_whole(wall_ids + i, (in_reach & (surface < walls)) ? surface : all(-1.0));
  }
  for (; i < count; ++i) {
    const bool in_reach = hits.range[i] <= range_max;
    if (ranges != nullptr) ranges[i] = in_reach ? hits.range[i] : kNoHit;
    if (wall_ids != nullptr)
      wall_ids[i] = in_reach && hits.surface[i] < walls ? static_cast<std::int32_t>(hits.surface[i]) : -1;
  }
}

/// One of the walls of a WallRuns, the same in every lane.
struct SweptWall {
  Doubles ax, ay, bx, by, ux, uy, rise, id;

  SweptWall(const WallRuns& w, int i, double id_)
      : ax(all(w.ax[i])),
        ay(all(w.ay[i])),
        bx(all(w.bx[i])),
        by(all(w.by[i])),
        ux(all(w.ux[i])),
        uy(all(w.uy[i])),
        rise(all(w.rise[i])),
        id(all(id_)) {}
};

// Groups of beams begin at multiples of their size. Beams of the first and last group that are not in the run are
// harmless, because the exact expression gives no hit.
void sweep_run(const SweptWall& wall, const BeamRun& run, const BeamFan& fan, const BeamHits& hits) {
  const double* const fan_dx = fan.dx;
  const double* const fan_dy = fan.dy;
  double* const ranges = hits.range;
  double* const surfaces = hits.surface;
  for (int i = run.first & -kLanes; i <= run.last; i += kLanes) {
    const Doubles dx = load(fan_dx + i);
    const Doubles dy = load(fan_dy + i);
    NearestLanes nearest{load(ranges + i), {}};
    const Doubles inverse = wall.ux * dx + wall.uy * dy + wall.rise;
    if (mask_bits(inverse * (nearest.range + 2 * kTie) >= 1.0) == 0) continue;  // hidden in all lanes
    nearest.surface = load(surfaces + i);
    nearest.offer(exact_wall_range(wall.ax, wall.ay, wall.bx, wall.by, dx, dy), wall.id);
    store(ranges + i, nearest.range);
    store(surfaces + i, nearest.surface);
  }
}

int length(const BeamRun& run) {
  return run.last < run.first ? 0 : run.last - run.first + 1;
}

/// kLanes walls, and the beams that they cover.
struct WallGroup {
  WallRuns walls;
  LaneRuns runs;
};

WallGroup wall_group(const WallView& view, int first, const BeamFan& fan, const BeamScale& scale) {
  const WallRuns walls = wall_runs(view, first, fan, scale);
  return {walls, lane_runs(walls.from, walls.width, scale)};
}

void sweep_group(const WallGroup& group, const double* ids, const BeamFan& fan, const BeamHits& hits) {
  for (int i = 0; i < kLanes; ++i) {
    if (i > 0 && ids[i] == ids[i - 1]) continue;  // padding of a leaf
    if (group.runs.is_empty(i)) continue;
    const SweptWall wall(group.walls, i, ids[i]);
    sweep_run(wall, group.runs.run(i), fan, hits);
    if (group.runs.last_behind[i] >= 0) sweep_run(wall, group.runs.run_behind(i), fan, hits);
  }
}

/// Sweeps the walls with indices [first, first + count); count is a multiple of 4.
void sweep_walls(const WallView& walls, int first, int count, const BeamFan& fan, const BeamScale& scale,
                 const BeamHits& hits) {
  for (int k = first; k < first + count; k += kLanes)
    sweep_group(wall_group(walls, k, fan, scale), walls.id + k, fan, hits);
}

// Computes the runs of several groups before their sweeps: a group is a long chain of operations, and a processor
// overlaps the chains of neighbours.
void sweep_all(const WallView& walls, const BeamFan& fan, const BeamHits& hits) {
  constexpr int kAtOnce = 16;
  const BeamScale scale(fan);
  for (int first = 0; first < walls.walls; first += kAtOnce) {
    const int count = walls.walls - first < kAtOnce ? walls.walls - first : kAtOnce;
    WallGroup groups[kAtOnce / kLanes];
    for (int k = 0; k < count; k += kLanes) groups[k / kLanes] = wall_group(walls, first + k, fan, scale);
    for (int k = 0; k < count; k += kLanes) sweep_group(groups[k / kLanes], walls.id + first + k, fan, hits);
  }
}

/// Four boxes as a sensor sees them.
struct BoxRuns {
  double nearest[TreeNode::kChildren];  ///< m: a lower bound of the range to a surface in the box
  double from[TreeNode::kChildren];     ///< beams, for beam_runs()
  double width[TreeNode::kChildren];
};

BoxRuns box_runs(const TreeNode& node, const BeamFan& fan, const BeamScale& scale) {
  BoxRuns runs;  // NOLINT(*-member-init): the loop sets every value
  for (int k = 0; k < TreeNode::kChildren; k += kLanes) {
    const Doubles x0 = load(node.low_x + k) - fan.origin_x;
    const Doubles x1 = load(node.high_x + k) - fan.origin_x;
    const Doubles y0 = load(node.low_y + k) - fan.origin_y;
    const Doubles y1 = load(node.high_y + k) - fan.origin_y;
    const Doubles zero = all(0.0);
    const Longs above = y0 > 0.0;
    const Longs below = y1 < 0.0;
    const Longs right = x0 > 0.0;
    const Longs left = x1 < 0.0;
    // The corners that the sensor sees at the ends of the box, counter-clockwise from `low` to `high`.
    const Doubles low_x = above ? x1 : (below ? x0 : (right ? x0 : x1));
    const Doubles low_y = above ? (x1 > 0.0 ? y0 : y1) : (below ? (x0 < 0.0 ? y1 : y0) : (right ? y0 : y1));
    const Doubles high_x = above ? x0 : (below ? x1 : (right ? x0 : x1));
    const Doubles high_y = above ? (x0 < 0.0 ? y0 : y1) : (below ? (x1 > 0.0 ? y1 : y0) : (right ? y1 : y0));
    const Doubles low = atan2_near(low_y, low_x);
    const Doubles high = atan2_near(high_y, high_x);
    Doubles arc = high - low;
    arc = arc < -1e-5 ? arc + 2 * kPiHere : arc;
    const Longs inside = ~(above | below | right | left);
    store(runs.from + k, scale.from(low, high));
    store(runs.width + k, inside ? all(1e9) : scale.width(arc));
    const Doubles nx = max(max(x0, -x1), zero);
    const Doubles ny = max(max(y0, -y1), zero);
    store(runs.nearest + k, sqrt(nx * nx + ny * ny) * (1 - 1e-6) - 1e-6);
  }
  return runs;
}

/// True if something at a range of `nearest` or more can be the first hit of a beam of the run.
bool can_be_seen(double nearest, const BeamRun& run, const double* ranges) {
  int i = run.first;
  for (; i <= run.last && i % kLanes != 0; ++i)
    if (nearest <= ranges[i]) return true;
  for (; i + kLanes <= run.last + 1; i += kLanes)
    if (mask_bits(nearest <= load(ranges + i)) != 0) return true;
  for (; i <= run.last; ++i)
    if (nearest <= ranges[i]) return true;
  return false;
}

/// Casts the few beams that hit a box one by one.
void walk_beams(const WallView& walls, int node, const BeamRun& run, const BeamFan& fan, const BeamHits& hits) {
  for (int i = run.first; i <= run.last; ++i) {
    NearestOne nearest{hits.range[i], hits.surface[i]};
    walk_tree(walls, {fan.origin_x, fan.origin_y, fan.dx[i], fan.dy[i]}, node, nearest);
    hits.range[i] = nearest.range;
    hits.surface[i] = nearest.surface;
  }
}

struct WaitingBox {
  double nearest;
  BeamRuns runs;
  int child;
  int count;
};

void sweep_tree(const WallView& walls, const BeamFan& fan, const BeamHits& hits) {
  constexpr int kFewBeams = 2;
  const BeamScale scale(fan);
  WaitingBox stack[3 * 32 + 1];
  int depth = 0;
  stack[depth++] = {0.0, {{{0, fan.beams - 1}, {0, -1}}}, 0, 0};
  while (depth > 0) {
    const WaitingBox box = stack[--depth];
    bool seen = false;
    for (const BeamRun& run : box.runs.runs) seen = seen || can_be_seen(box.nearest, run, hits.range);
    if (!seen) continue;
    if (box.child < 0) {
      sweep_walls(walls, ~box.child, box.count, fan, scale, hits);
      continue;
    }
    if (length(box.runs.runs[0]) + length(box.runs.runs[1]) <= kFewBeams) {
      for (const BeamRun& run : box.runs.runs) walk_beams(walls, box.child, run, fan, hits);
      continue;
    }
    const TreeNode& node = walls.nodes[box.child];
    const BoxRuns runs = box_runs(node, fan, scale);
    const int bottom = depth;
    for (int k = 0; k < TreeNode::kChildren; ++k) {
      if (node.child[k] == TreeNode::kNone) continue;
      const WaitingBox next{runs.nearest[k], beam_runs(runs.from[k], runs.width[k], scale.period, scale.beams),
                            node.child[k], node.count[k]};
      if (length(next.runs.runs[0]) + length(next.runs.runs[1]) == 0) continue;
      int at = depth++;  // farthest at the bottom
      for (; at > bottom && stack[at - 1].nearest < next.nearest; --at) stack[at] = stack[at - 1];
      stack[at] = next;
    }
  }
}

NearestSurface walk(const WallView& walls, double ox, double oy, double dx, double dy, double range_max) {
  NearestOne nearest{unhit_range(range_max), -1};
  walk_tree(walls, {ox, oy, dx, dy}, 0, nearest);
  return {nearest.range, nearest.surface};
}

}  // namespace

extern const CastKernels kCastKernels;  // NOLINT(readability-redundant-declaration): gives it a name outside
const CastKernels kCastKernels{
    .rotate = rotate, .clear = clear, .finish = finish, .sweep_all = sweep_all, .sweep_tree = sweep_tree, .walk = walk};

}  // namespace scanbench::sim::SCANBENCH_ISA
