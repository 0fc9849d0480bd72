// Casts one ray through the tree of walls, four boxes or walls at a time, nearest box first.
#pragma once

#include <cstdint>

#include "core/lanes/lanes.hpp"
#include "sim/cast/wall_view.hpp"
#include "sim/lanes/wall_lanes.hpp"

namespace scanbench::sim::SCANBENCH_ISA {

/// One ray's nearest surface, by the rule of NearestLanes.
struct NearestOne {
  double range;
  double surface;

  void offer(double r, double s) {
    if (!(r < kNoHit) || r > range + kTie) return;
    if (r < range - kTie || s < surface) surface = s;
    if (r < range) range = r;
  }
};

struct WalkRay {
  double ox, oy, dx, dy;
};

inline void walk_leaf(const WallView& walls, const WalkRay& ray, int first, int count, NearestOne& nearest) {
  for (int k = first; k < first + count; k += kLanes) {
    const auto r = exact_wall_range(load(walls.ax + k) - ray.ox, load(walls.ay + k) - ray.oy,
                                    load(walls.bx + k) - ray.ox, load(walls.by + k) - ray.oy, all(ray.dx), all(ray.dy));
    if (mask_bits(r <= nearest.range + kTie) == 0) continue;
    for (int i = 0; i < kLanes; ++i) nearest.offer(r[i], walls.id[k + i]);
  }
}

/// Where a ray enters the four boxes of a node; +inf for a box that it misses.
inline void enter_boxes(const TreeNode& node, const WalkRay& ray, double inverse_dx, double inverse_dy,
                        double (&entry)[TreeNode::kChildren]) {
  for (int k = 0; k < TreeNode::kChildren; k += kLanes) {
    const Doubles x0 = (load(node.low_x + k) - ray.ox) * inverse_dx;
    const Doubles x1 = (load(node.high_x + k) - ray.ox) * inverse_dx;
    const Doubles y0 = (load(node.low_y + k) - ray.oy) * inverse_dy;
    const Doubles y1 = (load(node.high_y + k) - ray.oy) * inverse_dy;
    const Doubles in = max(max(min(x0, x1), min(y0, y1)), all(0.0));
    const Doubles out = min(max(x0, x1), max(y0, y1));
    store(entry + k, in <= out ? in : all(kNoHit));
  }
}

// The inverse is large but finite, so that 0 times it is 0, not NaN.
inline double inverse_component(double d) {
  constexpr double kTiny = 1e-200;
  if (d > kTiny || d < -kTiny) return 1.0 / d;
  return d < 0 ? -1.0 / kTiny : 1.0 / kTiny;
}

/// Offers the walls below `node` that the ray hits up to `nearest.range`.
inline void walk_tree(const WallView& walls, const WalkRay& ray, int node_index, NearestOne& nearest) {
  struct Entry {
    double in;
    std::int32_t child;
    std::int32_t count;
  };
  constexpr double kSlack = 1e-6;  // tolerance of ranges against entries into boxes, which are larger than their walls
  const double inverse_dx = inverse_component(ray.dx);
  const double inverse_dy = inverse_component(ray.dy);
  Entry stack[3 * 32 + 1];  // three siblings wait on each level, and 4^32 walls do not fit into memory
  int depth = 0;
  stack[depth++] = {0.0, node_index, 0};
  while (depth > 0) {
    const Entry top = stack[--depth];
    if (top.in > nearest.range + kSlack) continue;
    if (top.child < 0) {
      walk_leaf(walls, ray, ~top.child, top.count, nearest);
      continue;
    }
    const TreeNode& node = walls.nodes[top.child];
    double entry[TreeNode::kChildren];
    enter_boxes(node, ray, inverse_dx, inverse_dy, entry);
    const int bottom = depth;
    for (int k = 0; k < TreeNode::kChildren; ++k) {
      if (node.child[k] == TreeNode::kNone || !(entry[k] <= nearest.range + kSlack)) continue;
      int at = depth++;  // farthest at the bottom
      for (; at > bottom && stack[at - 1].in < entry[k]; --at) stack[at] = stack[at - 1];
      stack[at] = {entry[k], node.child[k], node.count[k]};
    }
  }
}

}  // namespace scanbench::sim::SCANBENCH_ISA
