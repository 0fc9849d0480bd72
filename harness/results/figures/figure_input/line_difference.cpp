// Cuts lines into parts by the distances of their pixels.
#include "harness/results/figures/figure_input/line_difference.hpp"

#include <algorithm>
#include <cmath>

#include "core/index.hpp"
#include "core/params.hpp"

namespace scanbench::results {
namespace {

/// A set of pixels with the squared distance of each to the other set; no distances if that is empty.
struct JudgedPixels {
  const std::vector<Pixel>& pixels;
  const std::vector<std::int64_t>& distances;
  std::int64_t near;

  /// False for a pixel that is not in the set: the raster rounds the ends of a line, so it can have the neighbour.
  bool contains(const Pixel& pixel) const { return std::ranges::binary_search(pixels, pixel); }
  bool is_near(const Pixel& pixel) const {
    const auto at = std::ranges::lower_bound(pixels, pixel) - pixels.begin();
    return !distances.empty() && distances[as_index(at)] <= near;
  }
};

/// Appends the parts of the line to `near` or `far`. Each pixel of the line decides about its column, as
/// core/contracts/line_raster.hpp defines it.
void cut(const Segment& line, double pixel_m, const JudgedPixels& judged, std::vector<Segment>& near,
         std::vector<Segment>& far) {
  const Vec2 d = line.b - line.a;
  if (!line.a.allFinite() || !line.b.allFinite()) return;
  const bool steep = std::abs(d.y()) > std::abs(d.x());
  const Eigen::Index u = steep ? 1 : 0, v = 1 - u;
  const bool backwards = d[u] < 0;
  const Vec2 a = (backwards ? line.b : line.a) / pixel_m, b = (backwards ? line.a : line.b) / pixel_m;
  const double slope = b[u] > a[u] ? (b[v] - a[v]) / (b[u] - a[u]) : 0.0;
  const auto at = [&](double along) -> Vec2 {
    const double t = std::clamp(along, a[u], b[u]);
    const Vec2 p(t, a[v] + (t - a[u]) * slope);
    return pixel_m * (steep ? Vec2(p.y(), p.x()) : p);
  };
  const int first = static_cast<int>(std::floor(a[u] + 0.5)), last = static_cast<int>(std::floor(b[u] + 0.5));
  std::optional<bool> state;
  double begin = first - 0.5;
  for (int column = first; column <= last; ++column) {
    const auto across = static_cast<std::int32_t>(std::floor(a[v] + (column - a[u]) * slope + 0.5));
    const Pixel pixel = steep ? Pixel{.y = column, .x = across} : Pixel{.y = across, .x = column};
    const bool is_near = judged.contains(pixel) ? judged.is_near(pixel) : state.value_or(false);
    if (state && is_near != *state) {
      (*state ? near : far).push_back({at(begin), at(column - 0.5)});
      begin = column - 0.5;
    }
    state = is_near;
  }
  if (state) (*state ? near : far).push_back({at(begin), at(last + 0.5)});
}

}  // namespace

std::optional<render::PixelDifference> line_difference(const Recording& recording, const PipelineResult& result,
                                                       const metrics::RasterRules& rules) {
  const metrics::MetricInput input{recording.observed, recording.truth ? &*recording.truth : nullptr, result};
  if (!metrics::can_compare_rasters(input, rules)) return std::nullopt;
  const metrics::RasterComparison both = metrics::compare_rasters(input, rules);
  render::PixelDifference difference{.right_pixels = both.right(),
                                     .wrong_pixels = std::ssize(both.found) - both.right(),
                                     .missed_pixels = std::ssize(both.visible) - both.covered(),
                                     .pixel_m = rules.resolution_m,
                                     .tolerance_m = rules.tolerance_m};
  const JudgedPixels found{both.found, both.found_to_wall, both.near};
  const JudgedPixels visible{both.visible, both.visible_to_found, both.near};
  for (const Segment& line : both.found_lines) cut(line, both.pixel_m, found, difference.right, difference.wrong);
  std::vector<Segment> covered;
  for (const Segment& line : both.visible_lines) cut(line, both.pixel_m, visible, covered, difference.missed);
  for (std::vector<Segment>* lines : {&difference.right, &difference.wrong, &difference.missed})
    for (Segment& line : *lines) line = {both.world_from_raster + line.a, both.world_from_raster + line.b};
  return difference;
}

metrics::RasterRules raster_rules(const std::vector<study::ModuleChoice>& families) {
  const auto found = std::ranges::find(families, "raster_truth", &study::ModuleChoice::module);
  return found == families.end() ? metrics::RasterRules{} : make_params<metrics::RasterRules>(found->params);
}

}  // namespace scanbench::results
