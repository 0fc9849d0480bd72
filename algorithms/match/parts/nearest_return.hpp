// The return of a scan that is nearest to a point: beams next to the point's bearing first, a k-d tree where that would
// take many of them.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "algorithms/match/parts/scan_points.hpp"

namespace scanbench::matching {

/// The return nearest to a point.
struct Nearest {
  std::size_t index = 0;
  double square = 0.0;         ///< of its distance [m^2]
  double others_square = 0.0;  ///< no other return is nearer than the root of this; at most the gate's square
};

/// A moving point: the place of its last search, and what was found there.
struct Track {
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  Vec2 searched_at = Vec2::Zero();
  std::size_t partner = kNone;  ///< before the first search: a hint
  double others_square = -1.0;  ///< square of a distance from `searched_at` within which there is no other return
};

/// Searches one scan. Exact if the beams cover at most one turn. Holds scratch data: one object per thread.
class NearestReturn {
 public:
  explicit NearestReturn(const ReturnedPoints& scan);
  ~NearestReturn();
  NearestReturn(const NearestReturn&) = delete;
  NearestReturn& operator=(const NearestReturn&) = delete;

  /// The return nearest to p (sensor frame) within `gate_m`; absent if there is none. `hint` is an index near the
  /// answer; an index out of range is not a hint.
  std::optional<Nearest> find(const Vec2& p, double gate_m, std::size_t hint);

  /// Index of the same return. A point that has moved by m since its last search keeps its partner, without a new
  /// search, while the partner is nearer than the others were then, less m. All calls with one track have one gate.
  std::optional<std::size_t> follow(const Vec2& p, double gate_m, Track& track);

 private:
  class Tree;

  /// A return and the direction of its beam, next to each other in memory.
  struct Ray {
    Vec2 direction;
    Vec2 point;
  };

  std::size_t at_bearing(const Vec2& p, std::size_t hint) const;
  std::size_t next(std::size_t k) const { return k + 1 < scan_.size() ? k + 1 : 0; }
  std::size_t previous(std::size_t k) const { return k > 0 ? k - 1 : scan_.size() - 1; }

  const ReturnedPoints& scan_;
  std::vector<Ray> rays_;
  double sense_;  ///< 1: bearings grow with the beams, -1: they fall
  std::unique_ptr<Tree> tree_;
};

}  // namespace scanbench::matching
