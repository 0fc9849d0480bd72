// Draws the path, legends and notes that figures share.
#include "render/figures/parts/style.hpp"

#include <algorithm>
#include <variant>

#include <fmt/format.h>

namespace scanbench::render {

void add_path(const FigureInput& input, std::span<const Pose2> poses, const Stroke& stroke, Panel& panel) {
  std::vector<Vec2> places;
  for (const Pose2& pose : poses) places.push_back(pose.translation());
  if (input.continuous)
    panel.items.emplace_back(Polyline{.points = std::move(places), .stroke = stroke});
  else
    panel.items.emplace_back(Points{.points = std::move(places), .color = stroke.color, .size_pt = kPlaceSizePt});
}

LegendEntry path_legend(const FigureInput& input, const Stroke& stroke) {
  if (input.continuous) return {.text = "path of the sensor", .stroke = stroke};
  return {.text = "places of the sensor",
          .marker = Marker::dot,
          .marker_color = stroke.color,
          .marker_size_pt = kPlaceSizePt};
}

std::string names_of(const std::vector<NamedResult>& results, const std::vector<std::size_t>& group) {
  std::string names;
  for (const std::size_t i : group) names += (names.empty() ? "" : ", ") + results[i].pipeline;
  return names;
}

Color method_color(const std::vector<NamedResult>& results, std::size_t index) {
  std::vector<std::string> names;
  names.reserve(results.size());
  for (const NamedResult& named : results) names.push_back(named.pipeline);
  return method_styles(names)[index].color;
}

void add_method_legend(const std::vector<NamedResult>& results, const std::vector<std::vector<std::size_t>>& groups,
                       double width_pt, Scene& scene) {
  if (groups.size() > kListedMethods)
    scene.legend.push_back({.text = "lines, coloured by method", .stroke = Stroke{kGrey, width_pt, Dash::solid}});
  else
    for (const auto& group : groups)
      scene.legend.push_back({.text = names_of(results, group),
                              .stroke = Stroke{method_color(results, group.front()), width_pt, Dash::solid}});
}

Scene small_multiples(std::size_t panels) {
  Scene scene;
  scene.columns = panels <= 3   ? static_cast<int>(std::max<std::size_t>(1, panels))
                  : panels == 4 ? 2
                  : panels <= 9 ? 3
                                : 4;
  scene.width_in = scene.columns == 1 ? kSingleColumnIn : kDoubleColumnIn;
  scene.share_axes = true;
  scene.scale_bar = true;
  return scene;
}

void arrange_multiples(Scene& scene) {
  const Scene arranged = small_multiples(scene.panels.size());
  scene.columns = arranged.columns;
  scene.width_in = arranged.width_in;
  scene.share_axes = scene.scale_bar = true;
}

bool draws(const Scene& scene, const Stroke& stroke) {
  const auto same = [&](const Stroke& other) { return other.color == stroke.color && other.dash == stroke.dash; };
  const auto has = [&](const Item& item) {
    if (const auto* lines = std::get_if<Lines>(&item)) return !lines->segments.empty() && same(lines->stroke);
    const auto* line = std::get_if<Polyline>(&item);
    return line != nullptr && !line->points.empty() && same(line->stroke);
  };
  return std::ranges::any_of(scene.panels, [&](const Panel& panel) { return std::ranges::any_of(panel.items, has); });
}

void add_note(const std::string& text, Panel& panel) {
  if (!panel.x.range) panel.x.range = {0.0, 1.0};
  if (!panel.y.range) panel.y.range = {0.0, 1.0};
  const Vec2 middle(0.5 * (panel.x.range->first + panel.x.range->second),
                    0.5 * (panel.y.range->first + panel.y.range->second));
  panel.items.emplace_back(Text{.at = middle, .text = text, .offset_pt = {0, 0}, .color = kGrey, .movable = false});
}

std::string counted(std::size_t n, const std::string& noun) {
  return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
}

}  // namespace scanbench::render
