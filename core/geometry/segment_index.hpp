// A spatial index over segments that come and go: which of them are near a place. Its cost follows the number of
// segments found, not the number held.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/geometry/geometry.hpp"

namespace scanbench {

/// Segments by number, in an R-tree of their bounding boxes.
class SegmentIndex {
 public:
  SegmentIndex();
  /// Segments numbered from 0, whose boxes are larger than they by a margin each.
  SegmentIndex(std::span<const Segment> segments, std::span<const double> margins_m);
  ~SegmentIndex();
  SegmentIndex(const SegmentIndex&) = delete;
  SegmentIndex& operator=(const SegmentIndex&) = delete;
  SegmentIndex(SegmentIndex&&) noexcept;
  SegmentIndex& operator=(SegmentIndex&&) noexcept;

  /// The ends must be finite. A number is inserted once.
  void insert(std::size_t number, const Segment& segment);
  /// Both as they were inserted.
  void erase(std::size_t number, const Segment& segment);

  /// Numbers of the segments whose boxes come within `reach_m` of the box of any of the given segments, ascending, each
  /// once.
  std::vector<std::size_t> near(std::span<const Segment> segments, double reach_m) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace scanbench
