// Visits the boxes of a tree that a ray may hit, in no order, for surfaces that are not walls.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/geometry/geometry.hpp"
#include "sim/cast/wall_view.hpp"

namespace scanbench::sim {

/// Calls visit(index) for the surfaces in all leaves whose boxes the ray hits within `range`, which visit() may
/// shorten. An index may occur twice.
template <class Visit>
void walk_boxes(const WallView& tree, int node_index, const Vec2& origin, const Vec2& direction, const double& range,
                const Visit& visit) {
  const TreeNode& node = tree.nodes[node_index];
  for (std::size_t k = 0; k < TreeNode::kChildren; ++k) {
    if (node.child[k] == TreeNode::kNone) continue;
    const Vec2 half(0.5 * (node.high_x[k] - node.low_x[k]), 0.5 * (node.high_y[k] - node.low_y[k]));
    const Vec2 middle = Vec2(node.low_x[k], node.low_y[k]) + half - origin;
    // The box's reach along the ray and across it, about its middle.
    const double along = std::fabs(direction.x()) * half.x() + std::fabs(direction.y()) * half.y();
    const double across = std::fabs(direction.y()) * half.x() + std::fabs(direction.x()) * half.y();
    const double ahead = direction.dot(middle);
    if (std::fabs(cross(direction, middle)) > across || ahead < -along || ahead - along > range) continue;
    if (node.child[k] >= 0) {
      walk_boxes(tree, node.child[k], origin, direction, range, visit);
      continue;
    }
    const std::int32_t first = ~node.child[k];
    for (std::int32_t i = first; i < first + node.count[k]; ++i) visit(static_cast<std::size_t>(tree.id[i]));
  }
}

}  // namespace scanbench::sim
