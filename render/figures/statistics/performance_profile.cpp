// Performance profiles after Dolan and More, "Benchmarking optimization software with performance profiles",
// Mathematical Programming 91(2), 2002, section 2: for each pipeline the share of problems that it solves within a
// factor tau of the best pipeline. A problem is one seed of one scenario.
//
// Costs below the tolerance of the metric count as the tolerance: where the best cost is 0, a factor has no meaning. A
// share for which higher is better has the cost 1 - share.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/registry.hpp"
#include "render/figures/parts/measured.hpp"
#include "render/figures/parts/style.hpp"

namespace scanbench::render {
namespace {

constexpr double kProfileMarkerPt = 3.6;

/// Per problem the cost of each pipeline; +inf where it has no value or failed.
using Costs = std::vector<std::vector<double>>;

/// Equation (2.1) of the paper: the cost of a pipeline over that of the best one. Problems that none solves are kept,
/// with infinite ratios.
Costs ratios_of(Costs costs) {
  for (auto& problem : costs) {
    const double best = std::ranges::min(problem);
    for (double& cost : problem) cost = std::isfinite(best) ? cost / best : INFINITY;
  }
  return costs;
}

class PerformanceProfile : public Figure {
 public:
  struct Params {
    std::string metric;
    static auto fields() { return std::tuple{field("metric", &Params::metric, kRankedMetricDoc)}; }
  };
  explicit PerformanceProfile(const Params& params) : params_(params) {}

  bool spans_scenarios() const override { return true; }

  std::string why_nothing(const FigureInput& input) const override {
    if (pipelines_of(input).empty()) return no_value_of(metric_of(input));
    if (!cost(input, 0.5)) return fmt::format("no value of the metric {} is better than another", metric_of(input));
    return "fewer than two pipelines are in all scenarios";
  }

  std::vector<NamedScene> draw(const FigureInput& input) const override {
    const std::vector<std::string> names = pipelines_of(input);
    if (names.size() < 2 || !cost(input, 0.5)) return {};
    const Costs ratios = ratios_of(costs_of(input, names));
    double largest = 1.0;
    for (const auto& problem : ratios)
      for (const double ratio : problem)
        if (std::isfinite(ratio)) largest = std::max(largest, ratio);
    const double end = std::max(1.05 * largest, 1.1);
    const std::vector<MethodStyle> styles = method_styles(names);

    Scene scene{.title =
                    fmt::format("{}: performance profiles, {}", input.title, metric_words(input, metric_of(input)))};
    Panel panel{.x = {.label = "factor of the best cost, τ", .range = std::pair(1.0, end), .log = end > 5.0},
                .y = {.label = "share of problems", .range = std::pair(-0.03, 1.03)},
                .equal_aspect = false,
                .items = {}};
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::vector<Vec2> curve = steps(ratios, i, end);
      const Stroke stroke{styles[i].color, 1.2, styles[i].dash};
      Points marks{.marker = styles[i].marker, .color = stroke.color, .size_pt = kProfileMarkerPt};
      for (const double share : {0.25, 0.5, 0.75, 1.0})  // where the curve reaches them
        if (const auto at = std::ranges::find_if(curve, [&](const Vec2& p) { return p.y() >= share - 1e-9; });
            at != curve.end())
          marks.points.push_back(*at);
      panel.items.emplace_back(Polyline{.points = curve, .stroke = stroke});
      panel.items.emplace_back(std::move(marks));
      scene.legend.push_back({.text = names[i],
                              .stroke = stroke,
                              .marker = styles[i].marker,
                              .marker_color = stroke.color,
                              .marker_size_pt = kProfileMarkerPt});
    }
    scene.panels.push_back(std::move(panel));
    return {{"performance_profile",
             fmt::format("{}: the share of {} (seeds of {}) in which the {} of a pipeline is at most τ times that of "
                         "the best one. At τ = 1 the curves say how often each is the best; problems that a pipeline "
                         "fails are in no curve's share.",
                         input.title, counted(ratios.size(), "problem"), counted(input.scenarios.size(), "scenario"),
                         cost_text(input)),
             std::move(scene)}};
  }

 private:
  std::string metric_of(const FigureInput& input) const { return chosen_metric(input, params_.metric); }

  const MetricLook* look(const FigureInput& input) const {
    const auto found = input.looks.find(metric_of(input));
    return found == input.looks.end() ? nullptr : &found->second;
  }

  std::optional<double> cost(const FigureInput& input, double value) const {
    const auto cost = cost_of(input, metric_of(input), value);
    if (!cost) return std::nullopt;
    const MetricLook& metric = *look(input);
    const double raw = metric.best == MetricLook::Best::highest ? 1.0 + *cost : *cost;
    return std::max(raw, std::max(metric.tolerance, 1e-12));
  }

  std::string cost_text(const FigureInput& input) const {
    const MetricLook& metric = *look(input);
    const std::string words = metric_words(input, metric_of(input));
    if (metric.best == MetricLook::Best::highest) return "difference of " + words + " to 1";
    if (metric.best == MetricLook::Best::target) return fmt::format("distance of {} from {:g}", words, metric.target);
    return words;
  }

  /// The pipelines that are in all scenarios and have a value in one of them, in the order of the first scenario.
  std::vector<std::string> pipelines_of(const FigureInput& input) const {
    std::vector<std::string> names;
    if (input.scenarios.empty()) return names;
    for (const MeasuredPipeline& candidate : input.scenarios.front().pipelines) {
      bool everywhere = true, somewhere = false;
      for (const MeasuredScenario& scenario : input.scenarios) {
        const auto found = std::ranges::find(scenario.pipelines, candidate.pipeline, &MeasuredPipeline::pipeline);
        everywhere = everywhere && found != scenario.pipelines.end();
        somewhere = somewhere || (found != scenario.pipelines.end() && found->by_seed.contains(metric_of(input)));
      }
      if (everywhere && somewhere) names.push_back(candidate.pipeline);
    }
    return names;
  }

  Costs costs_of(const FigureInput& input, const std::vector<std::string>& names) const {
    Costs costs;
    for (const MeasuredScenario& scenario : input.scenarios) {
      std::size_t seeds = 0;
      for (const MeasuredPipeline& measured : scenario.pipelines)
        if (const auto values = measured.by_seed.find(metric_of(input)); values != measured.by_seed.end())
          seeds = std::max(seeds, values->second.size());
      const std::size_t first = costs.size();
      costs.resize(first + seeds, std::vector(names.size(), static_cast<double>(INFINITY)));
      for (std::size_t i = 0; i < names.size(); ++i) {
        const auto measured = std::ranges::find(scenario.pipelines, names[i], &MeasuredPipeline::pipeline);
        const auto values = measured->by_seed.find(metric_of(input));
        if (values == measured->by_seed.end()) continue;
        for (std::size_t s = 0; s < values->second.size(); ++s)
          if (std::isfinite(values->second[s])) costs[first + s][i] = *cost(input, values->second[s]);
      }
    }
    return costs;
  }

  /// Equation (2.2): the share of problems with a ratio of at most tau, as steps.
  static std::vector<Vec2> steps(const Costs& ratios, std::size_t pipeline, double end) {
    std::vector<double> sorted;
    for (const auto& problem : ratios)
      if (std::isfinite(problem[pipeline])) sorted.push_back(problem[pipeline]);
    std::ranges::sort(sorted);
    const auto all = static_cast<double>(ratios.size());
    std::vector<Vec2> points{{1.0, 0.0}};
    for (std::size_t k = 0; k < sorted.size(); ++k) {
      points.emplace_back(sorted[k], points.back().y());
      points.emplace_back(sorted[k], static_cast<double>(k + 1) / all);
    }
    points.emplace_back(end, points.back().y());
    return points;
  }

  Params params_;
};

SCANBENCH_REGISTER(
    Figure, PerformanceProfile,
    {.name = "performance_profile",
     .summary = "over all scenarios of a run, the share of problems that a pipeline solves within a factor of the best",
     .reference = "Dolan & More 2002, section 2"});

}  // namespace
}  // namespace scanbench::render
