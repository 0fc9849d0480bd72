// Builds the tree of walls by median splits.
#include "sim/cast/wall_tree.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>

namespace scanbench::sim {

struct WallTree::Builder {
  std::span<const Segment> walls;
  std::vector<std::int32_t> order;
  WallTree& tree;

  struct Box {
    Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity());
    Vec2 high = Vec2::Constant(-std::numeric_limits<double>::infinity());

    void add(const Vec2& p) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  };

  using Range = std::span<std::int32_t>;

  // Splits at the median of the midpoints. The size of the first half is a multiple of a leaf's, so that nearly all
  // leaves are full. Equal midpoints are ordered by index, so that the tree is always the same.
  std::array<Range, 2> split(Range range) const {
    if (range.size() <= kLeafWalls) return {range, Range()};
    Box box;
    for (const std::int32_t i : range) box.add(walls[static_cast<std::size_t>(i)].midpoint());
    const Vec2 size = box.high - box.low;
    const int axis = size.x() >= size.y() ? 0 : 1;
    const auto key = [&](std::int32_t i) { return walls[static_cast<std::size_t>(i)].midpoint()[axis]; };
    const std::size_t half = std::max<std::size_t>(1, (range.size() / 2 + kLeafWalls / 2) / kLeafWalls) * kLeafWalls;
    std::ranges::nth_element(range, range.begin() + static_cast<std::ptrdiff_t>(half),
                             [&](std::int32_t i, std::int32_t j) {
                               const double a = key(i);
                               const double b = key(j);
                               return a < b || (a == b && i < j);
                             });
    return {range.first(half), range.subspan(half)};
  }

  void set_box(TreeNode& node, std::size_t child, Range range) const {
    Box box;
    for (const std::int32_t i : range) {
      box.add(walls[static_cast<std::size_t>(i)].a);
      box.add(walls[static_cast<std::size_t>(i)].b);
    }
    node.low_x[child] = box.low.x() - kBoxMarginM;
    node.low_y[child] = box.low.y() - kBoxMarginM;
    node.high_x[child] = box.high.x() + kBoxMarginM;
    node.high_y[child] = box.high.y() + kBoxMarginM;
  }

  std::int32_t add_leaf(Range range) const {
    std::ranges::sort(range);
    const auto first = static_cast<std::int32_t>(tree.id_.size());
    const std::size_t padded = (range.size() + kLeafWalls - 1) / kLeafWalls * kLeafWalls;
    for (std::size_t k = 0; k < padded; ++k) {
      const std::int32_t i = range[std::min(k, range.size() - 1)];
      const Segment& wall = walls[static_cast<std::size_t>(i)];
      tree.ax_.push_back(wall.a.x());
      tree.ay_.push_back(wall.a.y());
      tree.bx_.push_back(wall.b.x());
      tree.by_.push_back(wall.b.y());
      tree.id_.push_back(i);
    }
    return ~first;
  }

  std::int32_t add_node(Range range) {
    const auto index = static_cast<std::int32_t>(tree.nodes_.size());
    tree.nodes_.emplace_back();
    std::array<Range, TreeNode::kChildren> parts{range};
    if (range.size() > kLeafWalls) {
      const auto [left, right] = split(range);
      const auto [a, b] = split(left);
      const auto [c, d] = split(right);
      parts = {a, b, c, d};
    }
    TreeNode node{};
    for (std::size_t k = 0; k < parts.size(); ++k) {
      set_box(node, k, parts[k]);
      if (parts[k].empty()) {
        node.child[k] = TreeNode::kNone;
      } else if (parts[k].size() <= kLeafWalls) {
        node.child[k] = add_leaf(parts[k]);
        node.count[k] = kLeafWalls;
      } else {
        node.child[k] = add_node(parts[k]);
      }
    }
    tree.nodes_[static_cast<std::size_t>(index)] = node;
    return index;
  }
};

WallTree::WallTree(std::span<const Segment> walls) {
  Builder builder{walls, std::vector<std::int32_t>(walls.size()), *this};
  std::iota(builder.order.begin(), builder.order.end(), 0);
  builder.add_node(builder.order);
}

WallView WallTree::view() const {
  return {ax_.data(), ay_.data(), bx_.data(), by_.data(), id_.data(), nodes_.data(), static_cast<int>(id_.size())};
}

}  // namespace scanbench::sim
