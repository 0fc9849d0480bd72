// The line map of each pipeline that makes one, over the points it was made from: small multiples.
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/registry.hpp"
#include "render/figures/parts/frames.hpp"
#include "render/figures/parts/style.hpp"
#include "render/figures/parts/view_box.hpp"
#include "render/figures/parts/visible_points.hpp"

namespace scanbench::render {
namespace {

constexpr std::size_t kMostLinesWithEnds = 200;  // in a panel: the ends of more would hide the lines

const Stroke kMapPathStroke{kGrey, 0.5, Dash::dotted};
constexpr double kMapLineWidth = 1.2;

class Map : public Figure {
 public:
  using Params = NoParams;
  explicit Map(const Params&) {}

  std::string why_nothing(const FigureInput&) const override { return "no pipeline has lines in a map"; }

  std::vector<NamedScene> draw(const FigureInput& input) const override {
    std::vector<std::size_t> with_map;
    std::size_t most_lines = 0;
    for (std::size_t i = 0; i < input.results.size(); ++i) {
      most_lines = std::max(most_lines, input.results[i].result->map.lines.size());
      if (!input.results[i].result->map.lines.empty()) with_map.push_back(i);
    }
    if (with_map.empty()) return {};
    auto groups = groups_of_equal(with_map.size(), [&](std::size_t i, std::size_t k) {
      return same_map(input, input.results[with_map[i]], input.results[with_map[k]]);
    });
    for (auto& group : groups)
      for (std::size_t& i : group) i = with_map[i];

    Scene scene = small_multiples(groups.size());
    scene.title = input.title + ": line maps";
    for (const auto& group : groups)
      scene.panels.push_back(panel_of(input, group, groups.size(), most_lines <= kMostLinesWithEnds));
    const bool points = show_points(input, groups, scene);
    if (points)
      scene.legend.push_back(
          {.text = "points of all scans", .marker = Marker::dot, .marker_color = kFaintPoints, .marker_size_pt = 2.0});
    add_method_legend(input.results, groups, kMapLineWidth, scene);
    scene.legend.push_back(path_legend(input, kMapPathStroke));
    return {{"map",
             input.title + (points ? ": the line map of each pipeline over the points of all scans."
                                   : ": the line map of each pipeline; its lines cover the points of the scans."),
             std::move(scene)}};
  }

 private:
  static std::vector<Segment> segments_of(const NamedResult& named) {
    std::vector<Segment> segments;
    for (const MapLine& line : named.result->map.lines) segments.push_back(line.segment);
    return segments;
  }

  static bool same_map(const FigureInput& input, const NamedResult& a, const NamedResult& b) {
    return segments_of(a) == segments_of(b) && !differ(place_frames(input.recording, a.result).world_from_sensor,
                                                       place_frames(input.recording, b.result).world_from_sensor);
  }

  /// Draws the points below the lines, if a panel has any that its lines do not hide.
  static bool show_points(const FigureInput& input, const std::vector<std::vector<std::size_t>>& groups, Scene& scene) {
    std::vector<Points> below;
    bool any = false;
    for (const auto& group : groups) {
      const NamedResult& named = input.results[group.front()];
      below.push_back({.points = placed_points(input, named, groups.size()), .color = kFaintPoints, .size_pt = 0.8});
      any = any || seen_beside(below.back().points, segments_of(named), kMapLineWidth, scene);
    }
    for (std::size_t k = 0; any && k < below.size(); ++k)
      scene.panels[k].items.insert(scene.panels[k].items.begin(), std::move(below[k]));
    return any;
  }

  static std::vector<Vec2> placed_points(const FigureInput& input, const NamedResult& named, std::size_t panels) {
    return all_points(input.recording, place_frames(input.recording, named.result).world_from_sensor,
                      kPointBudget / panels);
  }

  static Panel panel_of(const FigureInput& input, const std::vector<std::size_t>& group, std::size_t panels,
                        bool with_ends) {
    const NamedResult& named = input.results[group.front()];
    const PlacedFrames placed = place_frames(input.recording, named.result);
    const std::vector<Vec2> points = placed_points(input, named, panels);
    const Lines lines{.segments = segments_of(named),
                      .stroke = {method_color(input.results, group.front()), kMapLineWidth, Dash::solid}};
    const std::vector<Vec2> ends = ends_of(lines.segments);
    Panel panel{.title = names_of(input.results, group) + ": " + counted(lines.segments.size(), "line"),
                .tell_outside = "point"};
    panel.items.emplace_back(lines);
    if (with_ends)
      panel.items.emplace_back(
          Points{.points = ends, .marker = Marker::circle, .color = lines.stroke.color, .size_pt = 2.4});
    add_path(input, placed.world_from_sensor, kMapPathStroke, panel);
    set_view(points.empty() ? ends : points, {}, panel);
    return panel;
  }
};

SCANBENCH_REGISTER(Figure, Map,
                   {.name = "map",
                    .summary = "the line map of each pipeline over the points of all scans",
                    .reference = ""});

}  // namespace
}  // namespace scanbench::render
