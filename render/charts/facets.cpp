// Makes the items of each panel, from back to front: the other methods, the reference, the curves.
#include "render/charts/facets.hpp"

#include <algorithm>
#include <cmath>

#include "render/palette.hpp"

namespace scanbench::render {
namespace {

struct CurveStyle {
  Color color;
  Dash dash = Dash::solid;
  Marker marker = Marker::circle;
  bool filled = true;
};
constexpr std::array<CurveStyle, 2> kCurves{
    {{kBlue, Dash::solid, Marker::circle, true}, {kVermillion, Dash::dashed, Marker::square, false}}};
constexpr double kFacetCurveWidth = 1.2;
constexpr double kMarkerSize = 3.6;
const Stroke kOthers{{205, 205, 205}, 0.6, Dash::solid};
const Stroke kReference{kBlack, 0.9, Dash::dotted};

void add_curve(const FacetCurve& curve, const CurveStyle& style, Panel& panel) {
  panel.items.emplace_back(
      ErrorBars{.intervals = curve.intervals, .stroke = {style.color, 0.8, Dash::solid}, .cap_pt = 3.0});
  panel.items.emplace_back(Polyline{.points = curve.points, .stroke = {style.color, kFacetCurveWidth, style.dash}});
  panel.items.emplace_back(Points{.points = curve.points,
                                  .marker = style.marker,
                                  .color = style.color,
                                  .size_pt = kMarkerSize,
                                  .filled = style.filled});
}

void add_legend_entries(const FacetChart& chart, Scene& scene) {
  for (std::size_t i = 0; i < chart.curve_names.size(); ++i)
    scene.legend.push_back({.text = chart.curve_names[i],
                            .stroke = Stroke{kCurves[i].color, kFacetCurveWidth, kCurves[i].dash},
                            .marker = kCurves[i].marker,
                            .marker_color = kCurves[i].color,
                            .marker_size_pt = kMarkerSize,
                            .marker_filled = kCurves[i].filled});
  if (!chart.reference_name.empty()) scene.legend.push_back({.text = chart.reference_name, .stroke = kReference});
  if (!chart.others_name.empty()) scene.legend.push_back({.text = chart.others_name, .stroke = kOthers});
}

}  // namespace

std::pair<double, double> log_range(const std::vector<Facet>& facets, int coordinate) {
  constexpr double kRoom = 0.1;  // of the length of the axis: 6 pt or more of a panel, for a marker and an arrow
  double low = INFINITY, high = 0.0;
  const auto take = [&](const std::vector<Vec2>& points) {
    for (const Vec2& p : points) low = std::min(low, p[coordinate]), high = std::max(high, p[coordinate]);
  };
  for (const Facet& facet : facets) {
    take(facet.reference);
    for (const FacetCurve& curve : facet.curves) take(curve.points);
  }
  if (!(low < high)) return {0.1, 10.0};
  const double grow = std::max(1.25, std::pow(high / low, kRoom));
  return {low / grow, high * grow};
}

Scene facet_scene(const FacetChart& chart) {
  Scene scene;
  scene.title = chart.title;
  scene.width_in = kDoubleColumnIn;
  scene.columns = chart.facets.size() > 12 ? 5 : 4;
  scene.share_axes = true;
  scene.box_aspect = scene.columns > 4 ? 0.85 : 0.72;
  for (std::size_t i = 0; i < chart.facets.size(); ++i) {
    const Facet& facet = chart.facets[i];
    Panel panel{.title = facet.title, .x = chart.x, .y = chart.y, .equal_aspect = false, .items = {}};
    if (!chart.others_name.empty())
      for (std::size_t j = 0; j < chart.facets.size(); ++j)
        if (j != i && !chart.facets[j].curves.empty())
          panel.items.emplace_back(Polyline{.points = chart.facets[j].curves.front().points, .stroke = kOthers});
    if (!facet.reference.empty()) panel.items.emplace_back(Polyline{.points = facet.reference, .stroke = kReference});
    for (std::size_t c = 0; c < facet.curves.size() && c < kCurves.size(); ++c)
      add_curve(facet.curves[c], kCurves[c], panel);
    scene.panels.push_back(std::move(panel));
  }
  add_legend_entries(chart, scene);
  return scene;
}

}  // namespace scanbench::render
