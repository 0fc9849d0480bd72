// Walls sorted into a tree of boxes with four children per node.
#pragma once

#include <span>
#include <vector>

#include "core/geometry/geometry.hpp"
#include "sim/cast/wall_view.hpp"

namespace scanbench::sim {

class WallTree {
 public:
  static constexpr double kBoxMarginM = 1e-5;
  static constexpr int kLeafWalls = 4;

  WallTree() = default;
  /// Splits at the median of the midpoints along the longer side of their box: depth log4(n), the same tree for the
  /// same walls. Without walls the tree is an empty root.
  explicit WallTree(std::span<const Segment> walls);

  WallView view() const;

 private:
  struct Builder;

  std::vector<double> ax_, ay_, bx_, by_, id_;
  std::vector<TreeNode> nodes_;
};

}  // namespace scanbench::sim
