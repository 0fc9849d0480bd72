// The lines of a result and the true walls as pixels, and how far those are apart. Figures show the same comparison.
#pragma once

#include <cstdint>
#include <vector>

#include "core/contracts/line_raster.hpp"
#include "core/params.hpp"
#include "metrics/metric.hpp"

namespace scanbench::metrics {

enum class FoundLines { map_or_scans, scans };

/// The parameters of the family `raster_truth`.
struct RasterRules {
  double resolution_m = 0.01;
  double tolerance_m = 0.05;
  double min_hits_per_m = 30.0;
  FoundLines found = FoundLines::map_or_scans;
  static auto fields() {
    return std::tuple{
        field("resolution_m", &RasterRules::resolution_m, between(0.001, 1), "m", "side of a pixel"),
        field("tolerance_m", &RasterRules::tolerance_m, between(0, 100), "m",
              "largest distance of a right pixel from a pixel of the other lines"),
        field("min_hits_per_m", &RasterRules::min_hits_per_m, at_least(0), "1/m",
              "returns over the run that make a part of a wall visible"),
        choice("found", &RasterRules::found, {{FoundLines::map_or_scans, "map_or_scans"}, {FoundLines::scans, "scans"}},
               "the lines that are compared: those of the map, or of all scans if there is no map; or those of the "
               "scans, placed by the poses of the pipeline, or by the true ones if it estimates none")};
  }
};

/// Pixels and their distances; a list of distances is empty if one of its two sets of pixels is.
struct RasterComparison {
  Vec2 world_from_raster = Vec2::Zero();    ///< where the raster's zero is: lines and pixels are relative to it
  std::vector<Segment> found_lines;         ///< along the world's axes
  std::vector<Segment> visible_lines;       ///< the visible parts of the walls
  std::vector<Pixel> found;                 ///< of the found lines
  std::vector<Pixel> visible;               ///< of the visible parts
  std::vector<std::int64_t> found_to_wall;  ///< squared, in pixels, to the nearest pixel of any wall, per found pixel
  std::vector<std::int64_t> visible_to_found;  ///< squared, in pixels, per visible pixel
  double pixel_m = 0.01;
  std::int64_t near = 25;  ///< the largest squared distance, in pixels, within the tolerance

  std::int64_t right() const;    ///< found pixels near a wall
  std::int64_t covered() const;  ///< visible pixels near a found one
};

/// True if there are walls, and the map or the lines of scans that the rules request.
bool can_compare_rasters(const MetricInput& input, const RasterRules& rules);

/// Throws ConfigError if the lines are too long for the resolution (LineRaster::kMostPixels) or OSMesa is missing. The
/// input must satisfy can_compare_rasters().
RasterComparison compare_rasters(const MetricInput& input, const RasterRules& rules);

}  // namespace scanbench::metrics
