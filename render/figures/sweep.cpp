// A metric against a parameter that differs between pipelines of one kind: the mean over the seeds, and the band
// between the smallest and the largest value. There is a panel per parameter and a curve per kind of pipeline.
#include <algorithm>
#include <iterator>
#include <numeric>
#include <sstream>

#include <fmt/format.h>

#include "core/registry.hpp"
#include "render/figures/parts/measured.hpp"
#include "render/figures/parts/style.hpp"

namespace scanbench::render {
namespace {

const Stroke kTarget{kBlack, 0.6, Dash::dashed};

struct Sample {
  double x = 0.0;
  double low = 0.0;
  double mean = 0.0;
  double high = 0.0;
};

/// Pipelines that differ in one parameter only.
struct Curve {
  std::string name;
  std::vector<Sample> samples;  ///< by x
};

std::vector<std::string> words_of(std::string text) {
  std::ranges::replace(text, ',', ' ');
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

class Sweep : public Figure {
 public:
  struct Params {
    std::string parameters;
    std::string metric;
    std::vector<double> target{};
    static auto fields() {
      return std::tuple{
          field("parameters", &Params::parameters,
                "the varied parameters, one panel each: names like extract.threshold_m or [a list of them]; empty: all "
                "in which two pipelines differ alone"),
          field("metric", &Params::metric, kRankedMetricDoc),
          field("target", &Params::target, any_number(), "", "values at which a dashed line is drawn")};
    }
  };

  explicit Sweep(const Params& params) : params_(params) {}

  std::string why_nothing(const FigureInput& input) const override {
    const std::string metric = chosen_metric(input, params_.metric);
    const auto has_metric = [&](const MeasuredPipeline& measured) { return values_of(measured, metric) != nullptr; };
    if (std::ranges::none_of(input.measured, has_metric)) return no_value_of(metric);
    if (params_.parameters.empty()) return "no two pipelines differ in one parameter alone";
    return fmt::format("no two pipelines differ in {} alone", fmt::join(words_of(params_.parameters), " or "));
  }

  bool spans_seeds() const override { return true; }
  std::vector<NamedScene> draw(const FigureInput& input) const override {
    const std::string metric = chosen_metric(input, params_.metric), words = metric_words(input, metric);
    Scene scene;
    std::vector<std::string> names;  // of the curves in all panels
    std::size_t seeds = 0;
    for (const MeasuredPipeline& measured : input.measured)
      if (const auto* values = values_of(measured, metric)) seeds = std::max(seeds, values->size());
    std::vector<std::pair<Axis, std::vector<Curve>>> panels;  // by their x axis
    std::string against;                                      // "threshold and max angle"
    const std::vector<std::string> parameters =
        params_.parameters.empty() ? varied_parameters(input.measured, {metric}) : words_of(params_.parameters);
    for (const std::string& parameter : parameters) {
      std::vector<Curve> curves = curves_over(parameter, metric, input.measured);
      for (const Curve& curve : curves)
        if (std::ranges::find(names, curve.name) == names.end()) names.push_back(curve.name);
      if (curves.empty()) continue;
      against += (against.empty() ? "" : " and ") + parameter_words(parameter, input.measured);
      panels.emplace_back(parameter_axis(parameter, input.measured), std::move(curves));
    }
    const std::vector<MethodStyle> styles = method_styles(names);
    const Axis values = metric_axis(input, metric);
    for (const auto& [axis, curves] : panels) scene.panels.push_back(panel_of(axis, values, curves, names, styles));
    if (scene.panels.empty()) return {};
    scene.title = fmt::format("{}: {} against {}", input.title, words, against);
    if (scene.panels.size() > 1) scene.width_in = kDoubleColumnIn;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto [color, dash, marker] = styles[i];
      scene.legend.push_back(
          {.text = names[i], .stroke = Stroke{color, 1.2, dash}, .marker = marker, .marker_color = color});
    }
    if (!params_.target.empty())
      scene.legend.push_back({.text = fmt::format("target {:g}", fmt::join(params_.target, ", ")), .stroke = kTarget});
    std::string over_seeds;
    if (seeds > 1) {
      scene.legend.push_back({.text = "smallest to largest", .fill = lighten(kGrey, 0.7)});
      over_seeds = fmt::format(", mean over {} seeds and band between the smallest and the largest value", seeds);
    }
    return {{"sweep", fmt::format("{}: {} against {}{}.", input.title, words, against, over_seeds), std::move(scene)}};
  }

 private:
  static const std::vector<double>* values_of(const MeasuredPipeline& measured, const std::string& metric) {
    const auto found = measured.metrics.find(metric);
    return found == measured.metrics.end() || found->second.empty() ? nullptr : &found->second;
  }

  /// Curves of two points at least, in the order of their first pipelines.
  static std::vector<Curve> curves_over(const std::string& parameter, const std::string& metric,
                                        const std::vector<MeasuredPipeline>& all) {
    std::vector<Curve> curves;
    for (const VariedPipelines& group : varied_pipelines(parameter, all, {metric})) {
      Curve curve{group.name, {}};
      for (const auto& [x, measured] : group.members) {
        const std::vector<double>& values = *values_of(*measured, metric);
        const auto [low, high] = std::ranges::minmax(values);
        const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
        curve.samples.push_back({x, low, mean, high});
      }
      curves.push_back(std::move(curve));
    }
    return curves;
  }

  Panel panel_of(const Axis& x, const Axis& y, const std::vector<Curve>& curves, const std::vector<std::string>& names,
                 const std::vector<MethodStyle>& styles) const {
    Panel panel{.x = x, .y = y, .equal_aspect = false};
    const auto style_of = [&](const Curve& curve) {
      return styles[static_cast<std::size_t>(std::ranges::find(names, curve.name) - names.begin())];
    };
    for (const Curve& curve : curves) {  // bands are below all curves
      Polygon band{.fill = lighten(style_of(curve).color, 0.7)};
      for (const Sample& s : curve.samples) band.points.emplace_back(s.x, s.low);
      for (std::size_t i = curve.samples.size(); i-- > 0;)
        band.points.emplace_back(curve.samples[i].x, curve.samples[i].high);
      panel.items.emplace_back(std::move(band));
    }
    const double first =
        std::ranges::min(curves, {}, [](const Curve& c) { return c.samples.front().x; }).samples.front().x;
    const double last =
        std::ranges::max(curves, {}, [](const Curve& c) { return c.samples.back().x; }).samples.back().x;
    for (const double target : params_.target)
      panel.items.emplace_back(Polyline{.points = {{first, target}, {last, target}}, .stroke = kTarget});
    for (const Curve& curve : curves) {
      const auto [color, dash, marker] = style_of(curve);
      Polyline line{.stroke = {color, 1.2, dash}};
      for (const Sample& s : curve.samples) line.points.emplace_back(s.x, s.mean);
      Points marks{.points = line.points, .marker = marker, .color = color, .size_pt = 3.6};
      panel.items.emplace_back(std::move(line));
      panel.items.emplace_back(std::move(marks));
    }
    return panel;
  }

  Params params_;
};

SCANBENCH_REGISTER(Figure, Sweep,
                   {.name = "sweep",
                    .summary = "a metric against a parameter of the pipelines, with its band over seeds",
                    .reference = ""});

}  // namespace
}  // namespace scanbench::render
