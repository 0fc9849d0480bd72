// Draws found lines, walls and the visible parts of the walls on one raster, and measures the distances both ways.
#include "metrics/raster/raster_comparison.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/error.hpp"
#include "core/registry.hpp"
#include "metrics/raster/pixel_distances.hpp"
#include "metrics/walls/visible_walls.hpp"

namespace scanbench::metrics {
namespace {

/// The poses that place the lines of the scans: the pipeline's, or the true ones if it estimates none. Null if neither
/// has one per scan.
const std::vector<Pose2>* poses_of(const MetricInput& input) {
  const PipelineResult& result = input.result;
  const std::vector<Pose2>& poses =
      result.world_from_sensor.empty() ? input.truth->world_from_sensor : result.world_from_sensor;
  return !result.lines.empty() && poses.size() == result.lines.size() ? &poses : nullptr;
}

bool uses_map(const PipelineResult& result, FoundLines which) {
  return result.has_map && which == FoundLines::map_or_scans;
}

std::vector<Segment> found_lines(const MetricInput& input, FoundLines which) {
  const PipelineResult& result = input.result;
  std::vector<Segment> lines;
  if (uses_map(result, which)) {
    for (const MapLine& line : result.map.lines) lines.push_back(line.segment);
    return lines;
  }
  const std::vector<Pose2>* poses = poses_of(input);
  for (std::size_t f = 0; f < result.lines.size(); ++f)
    for (const LineFeature& line : result.lines[f].lines) lines.push_back((*poses)[f] * line.segment);
  return lines;
}

std::vector<Segment> visible_lines(const MetricInput& input, const Surfaces& surfaces, double hits_per_m) {
  const auto parts = visible_parts(input, surfaces, hits_per_m);
  std::vector<Segment> lines;
  for (std::size_t s = 0; s < parts.size(); ++s) {
    const Segment& wall = surfaces.segments[s];
    for (const Interval& part : parts[s])
      lines.push_back({wall.a + part.low * wall.direction(), wall.a + part.high * wall.direction()});
  }
  return lines;
}

/// A point near the walls, a whole number of blocks of pixels from the world's zero, which is itself such a point:
/// walls far away are drawn with the roundings that they would have near zero.
Vec2 origin_near(const std::vector<Segment>& walls, double pixel_m) {
  constexpr double kBlock = 65536;  // pixels
  if (walls.empty()) return Vec2::Zero();
  Vec2 corner = walls.front().a;
  for (const Segment& wall : walls) corner = corner.cwiseMin(wall.a).cwiseMin(wall.b);
  if (!corner.allFinite()) return Vec2::Zero();
  return kBlock * pixel_m * Vec2((corner / (kBlock * pixel_m)).array().round().matrix());
}

void shift(std::vector<Segment>& lines, const Vec2& by) {
  for (Segment& line : lines) line = {line.a + by, line.b + by};
}

std::int64_t count_near(const std::vector<std::int64_t>& distances, std::int64_t near) {
  return std::ranges::count_if(distances, [near](std::int64_t d) { return d <= near; });
}

}  // namespace

std::int64_t RasterComparison::right() const {
  return count_near(found_to_wall, near);
}

std::int64_t RasterComparison::covered() const {
  return count_near(visible_to_found, near);
}

bool can_compare_rasters(const MetricInput& input, const RasterRules& rules) {
  return knows_walls(input) && (uses_map(input.result, rules.found) || poses_of(input) != nullptr);
}

RasterComparison compare_rasters(const MetricInput& input, const RasterRules& rules) {
  SCANBENCH_ASSERT(can_compare_rasters(input, rules));
  const Surfaces surfaces = join_walls(input.truth->walls);
  RasterComparison both;
  both.found_lines = found_lines(input, rules.found);
  both.visible_lines = visible_lines(input, surfaces, rules.min_hits_per_m);
  std::vector<Segment> walls = surfaces.segments;
  both.world_from_raster = origin_near(walls, rules.resolution_m);
  for (std::vector<Segment>* lines : {&both.found_lines, &both.visible_lines, &walls})
    shift(*lines, -both.world_from_raster);
  both.pixel_m = rules.resolution_m;
  const double tolerance = rules.tolerance_m / rules.resolution_m;
  both.near = static_cast<std::int64_t>(tolerance * tolerance * (1.0 + 1e-9));  // 7 cm are 7 pixels of 1 cm
  const std::array layers{both.found_lines, walls, both.visible_lines};
  try {
    auto pixels = Registry<LineRaster>::make(LineRaster::kDefault)->draw(layers, rules.resolution_m);
    both.found_to_wall = squared_distances(pixels[0], pixels[1]);
    both.found = std::move(pixels[0]);
    both.visible = std::move(pixels[2]);
  } catch (const ConfigError& error) {
    throw ConfigError(std::string("raster_truth: ") + error.what());
  }
  both.visible_to_found = squared_distances(both.visible, both.found);
  return both;
}

}  // namespace scanbench::metrics
