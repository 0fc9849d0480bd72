// Writes polygon records as CSV rows.
#include "harness/io/exchange/polygon_files.hpp"

#include "core/geometry/polygon.hpp"
#include "harness/io/files/csv.hpp"

namespace scanbench::io {

std::string polygons_csv(const std::vector<ScanLines>& scans) {
  CsvWriter csv({"frame", "segment", "x1_m", "y1_m", "x2_m", "y2_m", "direction_x", "direction_y", "normal_x",
                 "normal_y", "length_m", "distance_m", "points", "flags"});
  for (std::size_t frame = 0; frame < scans.size(); ++frame) {
    long long index = 0;
    for (const PolygonSegment& s : polygon_of(scans[frame])) {
      csv.integer(static_cast<long long>(frame)).integer(index++);
      for (const auto& pair : {s.v1, s.v2, s.direction, s.normal})
        for (const float value : pair) csv.number(double{value});
      csv.number(double{s.length}).number(double{s.distance}).integer(s.count).integer(s.flags).end_row();
    }
  }
  return csv.str();
}

}  // namespace scanbench::io
