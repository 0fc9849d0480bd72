// Precision against recall of pipelines that differ in one parameter: a curve per kind of pipeline, over lines of equal
// F (van Rijsbergen, "Information retrieval", 1979, chapter 7).
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/registry.hpp"
#include "render/figures/parts/measured.hpp"
#include "render/figures/parts/style.hpp"

namespace scanbench::render {
namespace {

const Stroke kEqualF{{215, 215, 215}, 0.6, Dash::solid};
constexpr double kRecallMarkerPt = 3.6;

class PrecisionRecall : public Figure {
 public:
  struct Params {
    std::string parameter;
    std::string precision = "precision";
    std::string recall = "recall";
    static auto fields() {
      return std::tuple{
          field("parameter", &Params::parameter,
                "the parameter that varies along a curve, like extract.threshold_m; empty: the first in which two "
                "pipelines differ alone"),
          field("precision", &Params::precision, "the metric on the vertical axis"),
          field("recall", &Params::recall, "the metric on the horizontal axis")};
    }
  };
  explicit PrecisionRecall(const Params& params) : params_(params) {}

  std::string why_nothing(const FigureInput& input) const override {
    for (const std::string& metric : {params_.precision, params_.recall})
      if (std::ranges::none_of(input.measured, [&](const auto& m) { return band_of(m, metric).has_value(); }))
        return no_value_of(metric);
    return fmt::format("no two pipelines differ in {} alone",
                       params_.parameter.empty() ? "one parameter" : params_.parameter);
  }

  bool spans_seeds() const override { return true; }
  std::vector<NamedScene> draw(const FigureInput& input) const override {
    const std::vector<std::string> metrics{params_.precision, params_.recall};
    const std::vector<std::string> varied = varied_parameters(input.measured, metrics);
    const std::string parameter = params_.parameter.empty() && !varied.empty() ? varied.front() : params_.parameter;
    const std::vector<VariedPipelines> groups = varied_pipelines(parameter, input.measured, metrics);
    if (groups.empty()) return {};
    std::vector<std::string> names;
    names.reserve(groups.size());
    for (const VariedPipelines& group : groups) names.push_back(group.name);
    const std::vector<MethodStyle> styles = method_styles(names);

    Panel panel{.x = metric_axis(input, params_.recall),
                .y = metric_axis(input, params_.precision),
                .equal_aspect = false,
                .items = {}};
    std::vector<std::vector<Vec2>> curves;
    curves.reserve(groups.size());
    for (const VariedPipelines& group : groups) curves.push_back(means_of(group));
    const double lowest = set_ranges(curves, panel);
    add_equal_f(lowest, panel);
    const std::string precision = metric_words(input, params_.precision), recall = metric_words(input, params_.recall);
    Scene scene{.title = fmt::format("{}: {} against {}", input.title, precision, recall), .box_aspect = 0.85};
    for (std::size_t i = 0; i < groups.size(); ++i) {
      const auto& [color, dash, marker] = styles[i];
      panel.items.emplace_back(Polyline{.points = curves[i], .stroke = {color, 1.2, dash}});
      panel.items.emplace_back(
          Points{.points = curves[i], .marker = marker, .color = color, .size_pt = kRecallMarkerPt});
      for (const std::size_t end : {std::size_t{0}, curves[i].size() - 1})  // which way the parameter grows
        panel.items.emplace_back(Text{.at = curves[i][end],
                                      .text = fmt::format("{:.3g}", groups[i].members[end].first),
                                      .offset_pt = {3.0, 3.0},
                                      .color = color});
      scene.legend.push_back({.text = names[i],
                              .stroke = Stroke{color, 1.2, dash},
                              .marker = marker,
                              .marker_color = color,
                              .marker_size_pt = kRecallMarkerPt});
    }
    scene.legend.push_back({.text = "equal F", .stroke = kEqualF});
    scene.panels.push_back(std::move(panel));
    const std::size_t seeds = most_seeds(input, params_.precision);
    return {{"precision_recall",
             fmt::format("{}: {} against {} as {} varies, whose smallest and largest value are at the ends of each "
                         "curve{}.",
                         input.title, precision, recall, parameter_with_unit(parameter, input.measured),
                         seeds > 1 ? fmt::format("; means over {} seeds", seeds) : ""),
             std::move(scene)}};
  }

 private:
  std::vector<Vec2> means_of(const VariedPipelines& group) const {
    std::vector<Vec2> points;
    for (const auto& [value, measured] : group.members)
      points.emplace_back(band_of(*measured, params_.recall)->mean, band_of(*measured, params_.precision)->mean);
    return points;
  }

  /// Ranges from below the smallest value to 1; returns the smallest value.
  static double set_ranges(const std::vector<std::vector<Vec2>>& curves, Panel& panel) {
    Vec2 low(1.0, 1.0);
    for (const auto& curve : curves)
      for (const Vec2& p : curve) low = low.cwiseMin(p);
    const auto range = [](double smallest) {
      const double margin = 0.06 * std::max(1.0 - smallest, 0.02);
      return std::pair(std::max(smallest - margin, 0.0), 1.0 + margin);
    };
    panel.x.range = range(low.x());
    panel.y.range = range(low.y());
    return low.minCoeff();
  }

  /// Where 2 P R / (P + R) = F: P = F R / (2 R - F).
  static void add_equal_f(double lowest, Panel& panel) {
    const double step = lowest > 0.9 ? 0.02 : lowest > 0.6 ? 0.05 : 0.1;
    for (int i = 1; i * step < 1.0 - 1e-9; ++i) {
      const double f = i * step;
      Polyline line{.stroke = kEqualF};
      for (int k = 0; k <= 60; ++k) {
        const double recall = f / (2.0 - f) + (1.0 - f / (2.0 - f)) * k / 60.0;
        line.points.emplace_back(recall, f * recall / (2.0 * recall - f));
      }
      panel.items.emplace_back(std::move(line));
    }
  }

  Params params_;
};

SCANBENCH_REGISTER(
    Figure, PrecisionRecall,
    {.name = "precision_recall",
     .summary = "precision against recall of pipelines that differ in one parameter, over lines of equal F",
     .reference = "van Rijsbergen 1979, Information retrieval, chapter 7"});

}  // namespace
}  // namespace scanbench::render
