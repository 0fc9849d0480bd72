// A metric against the time that it takes: one point per pipeline with its interval, and the Pareto front of those that
// no other pipeline beats in both.
#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/pareto.hpp"
#include "core/registry.hpp"
#include "render/figures/parts/measured.hpp"
#include "render/figures/parts/style.hpp"

namespace scanbench::render {
namespace {

const Stroke kFront{kGrey, 1.0, Dash::dashed};
constexpr double kTimeMarkerPt = 5.0;

struct PlacedPipeline {
  std::string name;
  MeanBand time, quality;
  double cost = 0.0;
};

std::vector<PlacedPipeline> front_of(const std::vector<PlacedPipeline>& all) {
  std::vector<std::pair<double, double>> costs;
  costs.reserve(all.size());
  for (const PlacedPipeline& p : all) costs.emplace_back(p.time.mean, p.cost);
  std::vector<PlacedPipeline> front;
  for (const std::size_t i : pareto_front(costs)) front.push_back(all[i]);
  return front;
}

class AccuracyTime : public Figure {
 public:
  struct Params {
    std::string metric;
    std::string time{kScanTime};
    static auto fields() {
      return std::tuple{
          field("metric", &Params::metric, kRankedMetricDoc),
          field("time", &Params::time,
                "scan_time, the CPU time of all stages for one scan, or a metric of time: t_scan, t_match, "
                "t_align, t_total")};
    }
  };
  explicit AccuracyTime(const Params& params) : params_(params) {}

  std::string why_nothing(const FigureInput& input) const override {
    const std::string quality = chosen_metric(input, params_.metric);
    for (const std::string& metric : {quality, params_.time})
      if (std::ranges::none_of(input.measured, [&](const auto& m) { return band_of(m, metric).has_value(); }))
        return no_value_of(metric);
    return fmt::format("no value of the metric {} is better than another, or no pipeline has a time > 0", quality);
  }

  bool spans_seeds() const override { return true; }
  std::vector<NamedScene> draw(const FigureInput& input) const override {
    const std::string metric = chosen_metric(input, params_.metric);
    const std::vector<PlacedPipeline> placed = place(input, metric);
    if (placed.empty()) return {};
    std::vector<std::string> names;
    names.reserve(placed.size());
    for (const PlacedPipeline& p : placed) names.push_back(p.name);
    const std::vector<MethodStyle> styles = method_styles(names);

    Panel panel{
        .x = metric_axis(input, params_.time), .y = metric_axis(input, metric), .equal_aspect = false, .items = {}};
    panel.x.log = true;
    const std::vector<PlacedPipeline> front = front_of(placed);
    panel.items.emplace_back(stairs(front));
    Scene scene{.title = fmt::format("{}: {} against time", input.title, metric_words(input, metric))};
    for (std::size_t i = 0; i < placed.size(); ++i) {
      const PlacedPipeline& p = placed[i];
      const Stroke bar{styles[i].color, 0.8, Dash::solid};
      panel.items.emplace_back(
          ErrorBars{.intervals = {{p.time.mean, p.quality.low, p.quality.high}}, .stroke = bar, .cap_pt = 3.0});
      if (p.time.low > 0)
        panel.items.emplace_back(
            Lines{.segments = {{{p.time.low, p.quality.mean}, {p.time.high, p.quality.mean}}}, .stroke = bar});
      panel.items.emplace_back(Points{.points = {{p.time.mean, p.quality.mean}},
                                      .marker = styles[i].marker,
                                      .color = styles[i].color,
                                      .size_pt = kTimeMarkerPt});
      scene.legend.push_back({.text = p.name,
                              .marker = styles[i].marker,
                              .marker_color = styles[i].color,
                              .marker_size_pt = kTimeMarkerPt});
    }
    for (const PlacedPipeline& p : front)
      panel.items.emplace_back(Text{.at = {p.time.mean, p.quality.mean}, .text = p.name, .offset_pt = {4.0, 4.0}});
    scene.legend.push_back({.text = "Pareto front", .stroke = kFront});
    scene.panels.push_back(std::move(panel));
    const std::size_t seeds = most_seeds(input, metric);
    std::string names_of_front;
    for (const PlacedPipeline& p : front) names_of_front += (names_of_front.empty() ? "" : ", ") + p.name;
    return {{"accuracy_time",
             fmt::format("{}: {} against {}{}. No pipeline is better in one of both and as good in the other than one "
                         "of the Pareto front: {}.",
                         input.title, metric_words(input, metric), metric_words(input, params_.time),
                         seeds > 1 ? fmt::format(", means over {} seeds with {}", seeds,
                                                 has_ranges(input, metric) ? "the range of their values"
                                                                           : "their 95 % intervals")
                                   : "",
                         names_of_front),
             std::move(scene)}};
  }

 private:
  static bool has_ranges(const FigureInput& input, const std::string& metric) {
    return std::ranges::any_of(input.measured, [&](const MeasuredPipeline& measured) {
      const auto band = measured.bands.find(metric);
      return band != measured.bands.end() && band->second.is_range;
    });
  }

  std::vector<PlacedPipeline> place(const FigureInput& input, const std::string& metric) const {
    std::vector<PlacedPipeline> placed;
    for (const MeasuredPipeline& measured : input.measured) {
      const auto time = band_of(measured, params_.time), quality = band_of(measured, metric);
      if (!time || !quality || !(time->mean > 0)) continue;
      const std::optional<double> cost = cost_of(input, metric, quality->mean);
      if (!cost) return {};
      placed.push_back({measured.pipeline, *time, *quality, *cost});
    }
    return placed;
  }

  /// The best value within each time: steps from one pipeline of the front to the next.
  static Polyline stairs(const std::vector<PlacedPipeline>& front) {
    Polyline line{.stroke = kFront};
    for (const PlacedPipeline& p : front) {
      if (!line.points.empty()) line.points.emplace_back(p.time.mean, line.points.back().y());
      line.points.emplace_back(p.time.mean, p.quality.mean);
    }
    return line;
  }

  Params params_;
};

SCANBENCH_REGISTER(Figure, AccuracyTime,
                   {.name = "accuracy_time",
                    .summary = "a metric against time, one point per pipeline, with the Pareto front",
                    .reference = ""});

}  // namespace
}  // namespace scanbench::render
