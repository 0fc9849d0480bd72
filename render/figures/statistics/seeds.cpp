// The values of a metric over the seeds: a dot for each, the mean and its 95 % interval, one row per pipeline.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/registry.hpp"
#include "render/figures/parts/measured.hpp"
#include "render/figures/parts/style.hpp"

namespace scanbench::render {
namespace {

constexpr double kSeedDotPt = 3.0;
const Stroke kInterval{kBlack, 1.2, Dash::solid};

/// Offsets across the row, in rows, so that values nearer to each other than `width` do not cover each other: each
/// value takes the lane nearest to the middle that is free there. Of more values than lanes some cover others.
std::vector<double> spread(const std::vector<double>& sorted, double width) {
  constexpr double kLanes[] = {0.0, 0.09, -0.09, 0.18, -0.18, 0.27, -0.27, 0.36, -0.36};
  std::array<double, std::size(kLanes)> last{};
  last.fill(-INFINITY);
  std::vector<double> offsets;
  for (const double value : sorted) {
    auto lane = std::ranges::find_if(last, [&](double before) { return value - before >= width; });
    if (lane == last.end()) lane = std::ranges::min_element(last);
    *lane = value;
    offsets.push_back(kLanes[static_cast<std::size_t>(lane - last.begin())]);
  }
  return offsets;
}

class Seeds : public Figure {
 public:
  struct Params {
    std::string metric;
    static auto fields() { return std::tuple{field("metric", &Params::metric, kRankedMetricDoc)}; }
  };
  explicit Seeds(const Params& params) : params_(params) {}

  std::string why_nothing(const FigureInput& input) const override {
    return no_value_of(chosen_metric(input, params_.metric));
  }

  bool spans_seeds() const override { return true; }
  std::vector<NamedScene> draw(const FigureInput& input) const override {
    const std::string metric = chosen_metric(input, params_.metric), words = metric_words(input, metric);
    std::vector<const MeasuredPipeline*> shown;
    for (const MeasuredPipeline& measured : input.measured)
      if (band_of(measured, metric)) shown.push_back(&measured);
    if (shown.empty()) return {};
    std::vector<std::string> names;
    double low = INFINITY, high = -INFINITY;
    for (const MeasuredPipeline* measured : shown) {
      names.push_back(measured->pipeline);
      const auto [least, most] = std::ranges::minmax(measured->metrics.at(metric));
      low = std::min(low, least), high = std::max(high, most);
    }
    const std::vector<MethodStyle> styles = method_styles(names);
    const auto rows = static_cast<double>(shown.size());
    Panel panel{.x = metric_axis(input, metric),
                .y = {.range = std::pair(-0.5, rows - 0.5), .grid = false},
                .equal_aspect = false,
                .items = {}};
    for (std::size_t i = 0; i < shown.size(); ++i) {
      const double row = rows - 1.0 - static_cast<double>(i);  // the first pipeline is on top
      panel.y.ticks.emplace_back(row, names[i]);
      add_row(*shown[i], metric, row, styles[i].color, (high - low) / 60.0, panel);
    }
    Scene scene{.title = fmt::format("{}: {} over the seeds", input.title, words),
                .box_aspect = std::clamp(0.13 * rows, 0.3, 2.0)};
    const bool few = band_of(*shown.front(), metric)->is_range;
    const std::string spread = few ? "range" : "95 % interval";
    scene.legend = {{.text = "one seed", .marker = Marker::circle, .marker_color = kGrey, .marker_size_pt = kSeedDotPt},
                    {.text = "mean and " + spread,
                     .stroke = kInterval,
                     .marker = Marker::diamond,
                     .marker_color = kBlack,
                     .marker_size_pt = 4.5}};
    scene.panels.push_back(std::move(panel));
    const std::size_t seeds = most_seeds(input, metric);
    return {{"seeds",
             fmt::format("{}: {} of each of {}, with the mean and {}.", input.title, words, counted(seeds, "seed"),
                         few ? "the range, because so few have no interval" : "its 95 % interval"),
             std::move(scene)}};
  }

 private:
  static void add_row(const MeasuredPipeline& measured, const std::string& metric, double row, Color color,
                      double width, Panel& panel) {
    std::vector<double> values = measured.metrics.at(metric);
    std::ranges::sort(values);
    const std::vector<double> offsets = spread(values, width);
    Points dots{.marker = Marker::circle, .color = color, .size_pt = kSeedDotPt};
    for (std::size_t k = 0; k < values.size(); ++k) dots.points.emplace_back(values[k], row + offsets[k]);
    const MeanBand band = *band_of(measured, metric);
    const auto cap = [&](double x) { return Segment{{x, row - 0.12}, {x, row + 0.12}}; };
    if (band.high > band.low)
      panel.items.emplace_back(
          Lines{.segments = {{{band.low, row}, {band.high, row}}, cap(band.low), cap(band.high)}, .stroke = kInterval});
    panel.items.emplace_back(std::move(dots));  // over the interval, which would hide those of a few seeds
    panel.items.emplace_back(
        Points{.points = {{band.mean, row}}, .marker = Marker::diamond, .color = kBlack, .size_pt = 4.5});
  }

  Params params_;
};

SCANBENCH_REGISTER(Figure, Seeds,
                   {.name = "seeds",
                    .summary = "a metric over the seeds: a dot for each, the mean and its 95 % interval (their range "
                               "below six seeds), a row per pipeline",
                    .reference = ""});

}  // namespace
}  // namespace scanbench::render
