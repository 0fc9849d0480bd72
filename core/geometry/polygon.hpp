// The polygonal representation of a scan: its lines as 48-byte records, neighbours joined at common vertices.
// Siadat et al. 1997, section 6 and eqs 7-9, fig. 10.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "core/scan.hpp"

namespace scanbench {

/// A segment V1 -> V2 with everything that position correction needs repeatedly, 32 bits per field, sensor frame,
/// metres. Its normalised implicit line is a x + b y + c = 0 with (a, b) = normal and c = -distance (eq. 8). The normal
/// points away from the origin, so that the origin's side is negative; for a line through the origin either normal is
/// possible. A record without a direction (one point) has length 0 and a normal along its ray, and is not `valid`.
struct PolygonSegment {
  enum Flag : std::uint32_t {
    valid = 1,   ///< has a direction
    joined = 2,  ///< V2 is V1 of the next record
  };

  std::array<float, 2> v1{};
  std::array<float, 2> v2{};
  std::array<float, 2> direction{};  ///< unit vector from V1 to V2
  std::array<float, 2> normal{};     ///< unit vector, across the direction
  float length = 0.0F;
  float distance = 0.0F;    ///< of the line from the origin, >= 0
  std::uint32_t count = 0;  ///< points that support it
  std::uint32_t flags = 0;

  /// d = a x + b y + c (eq. 9): negative between the origin and the line, positive beyond it.
  double oriented_distance(const Vec2& p) const {
    return double{normal[0]} * p.x() + double{normal[1]} * p.y() - double{distance};
  }
  Segment segment() const;
  PolarLine line() const;
  bool operator==(const PolygonSegment&) const = default;
};
static_assert(sizeof(PolygonSegment) == 48, "the paper's size");
static_assert(std::is_trivially_copyable_v<PolygonSegment> && std::is_standard_layout_v<PolygonSegment>);

/// The conditions for two neighbours to share a vertex.
struct JoinRules {
  double gap_m = 0.2;                 ///< largest distance of the facing ends, and of either from the corner
  double corner_rad = radians(10.0);  ///< lines at a larger angle than this meet in their intersection
};

/// The record of one line, computed in double and rounded once.
PolygonSegment polygon_segment(const LineFeature& line);

/// The records of a scan's lines in their order. The facing ends of neighbours become one vertex if they are within
/// rules.gap_m of each other: the intersection of the two lines if they make a corner and the intersection is within
/// rules.gap_m of both ends, else the midpoint of the ends. Direction, normal, length and distance are those of the
/// moved vertices. Without lines there are no records.
std::vector<PolygonSegment> polygon_of(const ScanLines& scan, const JoinRules& rules = {});

}  // namespace scanbench
