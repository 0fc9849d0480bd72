// Walls in a tree of boxes as plain numbers and pointers, for the kernels of sim/lanes/.
#pragma once

#include <cstdint>

namespace scanbench::sim {

/// The boxes of up to four children, in world coordinates. Each is larger than its walls by kBoxMarginM on all
/// sides, which exceeds all rounding errors in a world that validate() accepts.
struct alignas(32) TreeNode {
  static constexpr int kChildren = 4;
  double low_x[kChildren];
  double low_y[kChildren];
  double high_x[kChildren];
  double high_y[kChildren];
  std::int32_t child[kChildren];  ///< >= 0: a node; < 0: a leaf, its walls begin at index ~child; kNone
  std::int32_t count[kChildren];  ///< walls of a leaf

  static constexpr std::int32_t kNone = 0x7fffffff;
};

/// The arrays of a WallTree.
struct WallView {
  const double* ax;  ///< ends of the walls in the tree's order
  const double* ay;
  const double* bx;
  const double* by;
  const double* id;  ///< index of the wall in the world; a double so that lanes can compare it
  const TreeNode* nodes;
  int walls;  ///< a multiple of 4: leaves are filled up by repeating a wall
};

}  // namespace scanbench::sim
