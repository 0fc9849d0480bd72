// The return of a scan that is nearest to a point: beams next to the point's bearing first, a k-d tree where that would
// take many of them.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "algorithms/match/parts/scan_points.hpp"

namespace scanbench::matching {

/// Searches one scan. Exact if the beams cover at most one turn. Holds scratch data: one object per thread.
class NearestReturn {
 public:
  explicit NearestReturn(const ReturnedPoints& scan);
  ~NearestReturn();
  NearestReturn(const NearestReturn&) = delete;
  NearestReturn& operator=(const NearestReturn&) = delete;

  /// Index of the return nearest to p (sensor frame) within `gate_m`; absent if there is none. `hint` is an index near
  /// the answer, such as the last answer for a point that has moved little; an index out of range is no hint.
  std::optional<std::size_t> find(const Vec2& p, double gate_m, std::size_t hint);

 private:
  class Tree;

  std::size_t at_bearing(const Vec2& p, std::size_t hint) const;
  std::size_t next(std::size_t k) const { return k + 1 < scan_.size() ? k + 1 : 0; }
  std::size_t previous(std::size_t k) const { return k > 0 ? k - 1 : scan_.size() - 1; }

  const ReturnedPoints& scan_;
  double sense_;  ///< 1: bearings grow with the beams, -1: they fall
  std::unique_ptr<Tree> tree_;
};

}  // namespace scanbench::matching
