// raster_truth: the lines of a result beside the true walls as two pictures, drawn one pixel wide, and the distances
// between their pixels. Unlike map_truth it judges no line as a whole, so it holds for maps and for the lines of single
// scans, however they are cut into pieces.
//
// Recall is about the visible parts of the walls, precision about all walls, as in map_truth: a line on a part of a
// wall that only a few returns show is not false. The comparison is made without an alignment.
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/contracts/line_raster.hpp"
#include "core/error.hpp"
#include "core/registry.hpp"
#include "metrics/raster/raster_comparison.hpp"
#include "metrics/rows.hpp"

namespace scanbench::metrics {
namespace {

/// The distances from the pixels of one set to the nearest of the other, in metres.
struct Directed {
  double mean = kUndefined;
  double most = kUndefined;      ///< 95 % of the pixels are at most this far
  double farthest = kUndefined;  ///< all of them
};

Directed summary_of(std::vector<std::int64_t> squared, double pixel_m) {
  if (squared.empty()) return {};
  const auto metres = [&](std::int64_t d) { return pixel_m * std::sqrt(static_cast<double>(d)); };
  Mean mean;
  for (const std::int64_t d : squared) mean.add(metres(d));
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(0.95 * number(squared.size()) - 1e-9)) - 1;
  std::ranges::nth_element(squared, squared.begin() + rank);
  const std::int64_t largest = *std::max_element(squared.begin() + rank, squared.end());
  return {mean.value(), metres(squared[static_cast<std::size_t>(rank)]), metres(largest)};
}

class RasterTruth : public MetricFamily {
 public:
  using Params = RasterRules;
  explicit RasterTruth(const Params& params) : params_(params) {}

  std::vector<MetricDescription> describe() const override {
    using enum Direction;
    return {share({"raster_precision", "raster precision", "", higher_is_better, 0.005,
                   "share of the pixels of found lines within tolerance_m of a pixel of a wall"}),
            share({"raster_recall", "raster recall", "", higher_is_better, 0.005,
                   "share of the pixels of visible walls within tolerance_m of a pixel of a found line"}),
            share({"raster_f1", "raster F1", "", higher_is_better, 0.005,
                   "harmonic mean of raster_precision and raster_recall"}),
            {"raster_chamfer", "chamfer distance", "m", lower_is_better, 0.002,
             "mean distance from found pixels to walls and mean distance from visible pixels to found ones, averaged"},
            {"raster_hausdorff95", "Hausdorff distance, 95 %", "m", lower_is_better, 0.01,
             "distance within which 95 % of the found pixels have a pixel of a wall, and 95 % of the visible pixels of "
             "walls a found one"},
            {"raster_hausdorff", "Hausdorff distance", "m", lower_is_better, 0.02,
             "largest distance from a found pixel to a wall, or from a visible pixel of a wall to a found one"},
            {"raster_pixels", "wall pixels", "", neither, 0.0, "pixels of the visible parts of the walls"}};
  }

  /// Loading the library takes longer than most cells.
  void prepare() const override { Registry<LineRaster>::make(LineRaster::kDefault)->load(); }

  bool applies(const MetricInput& input) const override { return can_compare_rasters(input, params_); }

  std::vector<MetricRow> evaluate(const MetricInput& input) const override {
    SCANBENCH_ASSERT(applies(input));
    const RasterComparison both = compare_rasters(input, params_);
    const auto n_found = std::ssize(both.found), n_visible = std::ssize(both.visible);
    const double precision = ratio(number(both.right()), number(n_found));
    const double recall = ratio(number(both.covered()), number(n_visible));
    const Directed from_found = summary_of(both.found_to_wall, both.pixel_m);
    const Directed from_visible = summary_of(both.visible_to_found, both.pixel_m);
    const auto worse = [](double a, double b) { return std::isnan(a) || std::isnan(b) ? kUndefined : std::max(a, b); };

    Rows rows(describe());
    rows.add("raster_precision", kAll, precision, n_found);
    rows.add("raster_recall", kAll, recall, n_visible);
    rows.add("raster_f1", kAll, f1(precision, recall), n_found + n_visible);
    rows.add("raster_chamfer", kAll, 0.5 * (from_found.mean + from_visible.mean), n_found + n_visible);
    rows.add("raster_hausdorff95", kAll, worse(from_found.most, from_visible.most), n_found + n_visible);
    rows.add("raster_hausdorff", kAll, worse(from_found.farthest, from_visible.farthest), n_found + n_visible);
    rows.add("raster_pixels", kAll, number(n_visible), n_visible);
    return rows.take();
  }

 private:
  /// 0 if nothing is right, also where nothing was found; undefined if there is neither a found nor a visible pixel.
  static double f1(double precision, double recall) {
    if (std::isnan(precision) && std::isnan(recall)) return kUndefined;
    if (std::isnan(precision) || std::isnan(recall) || !(precision + recall > 0)) return 0.0;
    return 2.0 * precision * recall / (precision + recall);
  }

  Params params_;
};

SCANBENCH_REGISTER(
    MetricFamily, RasterTruth,
    {.name = "raster_truth",
     .summary = "found lines and true walls as pixels: precision, recall, F, Chamfer and Hausdorff distances",
     .reference = "this project"});

}  // namespace
}  // namespace scanbench::metrics
