// The trace rows of mappers, from which figures are drawn (docs/algorithms/dse.md, "Trace rows"). A row belongs to the
// frame of the scan that was inserted; coordinates are in the world frame.
#pragma once

#include <string_view>
#include <tuple>

#include "core/trace/trace_schema.hpp"

namespace scanbench::mapping {

/// One scan inserted.
struct InsertionRow {
  static constexpr std::string_view kName = "insertion";
  int scan_lines = 0;  ///< usable ones
  int polylines = 0;   ///< generalized polylines that they form
  int near_lines = 0;  ///< of the map, near the scan
  int children = 0;    ///< of restrictive pairing
  int map_lines = 0;   ///< after the scan
  double share = 0.0;  ///< of the scan that met the map
  double rms_m = 0.0;  ///< of the distances of pairs
  static constexpr auto columns() {
    using R = InsertionRow;
    return std::tuple{column("scan_lines", &R::scan_lines),
                      column("polylines", &R::polylines),
                      column("near_lines", &R::near_lines),
                      column("children", &R::children),
                      column("map_lines", &R::map_lines),
                      column("share", &R::share),
                      column("rms_m", &R::rms_m)};
  }
};

/// A main direction that the scan was merged with.
struct DirectionRow {
  static constexpr std::string_view kName = "direction";
  int rank = 0;            ///< 0: the strongest
  double angle_rad = 0.0;  ///< in [0, pi)
  double weight_m = 0.0;   ///< length of the recent map lines about it
  static constexpr auto columns() {
    using R = DirectionRow;
    return std::tuple{column("rank", &R::rank), column("angle_rad", &R::angle_rad), column("weight_m", &R::weight_m)};
  }
};

/// A line that the map has from this scan on.
struct BornRow {
  static constexpr std::string_view kName = "born";
  int line = 0;  ///< its number, never used again
  double x1_m = 0.0;
  double y1_m = 0.0;
  double x2_m = 0.0;
  double y2_m = 0.0;
  static constexpr auto columns() {
    using R = BornRow;
    return std::tuple{column("line", &R::line), column("x1_m", &R::x1_m), column("y1_m", &R::y1_m),
                      column("x2_m", &R::x2_m), column("y2_m", &R::y2_m)};
  }
};

/// A line that the map no longer has: others replace it.
struct GoneRow {
  static constexpr std::string_view kName = "gone";
  int line = 0;
  static constexpr auto columns() { return std::tuple{column("line", &GoneRow::line)}; }
};

}  // namespace scanbench::mapping
