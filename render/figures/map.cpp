// The line map of each pipeline that makes one, over the points it was made from: small multiples.
#include <algorithm>

#include <fmt/format.h>

#include "core/registry.hpp"
#include "render/figures/parts/frames.hpp"
#include "render/figures/parts/looks.hpp"
#include "render/figures/parts/view_box.hpp"

namespace scanbench::render {
namespace {

constexpr std::size_t kMostLinesWithEnds = 200;  // in any panel: the ends of more would hide the lines

class Map : public Figure {
 public:
  using Params = NoParams;
  explicit Map(const Params&) {}

  std::vector<NamedScene> draw(const FigureInput& input) const override {
    const Recording& recording = input.recording;
    const auto has_map = [](const NamedResult& r) { return !r.result->map.lines.empty(); };
    const auto maps = static_cast<std::size_t>(std::count_if(input.results.begin(), input.results.end(), has_map));
    if (maps == 0) return {};

    Scene scene = small_multiples(maps);
    scene.title = input.title + ": line maps";
    std::size_t most_lines = 0;
    for (const NamedResult& r : input.results) most_lines = std::max(most_lines, r.result->map.lines.size());
    const Stroke path_stroke{kGrey, 0.5, Dash::dotted};
    std::vector<LegendEntry> swatches;  // a colour of the panels each
    for (std::size_t i = 0; i < input.results.size(); ++i) {
      if (!has_map(input.results[i])) continue;
      const std::string& pipeline = input.results[i].pipeline;
      const PipelineResult* result = input.results[i].result;
      const PlacedFrames placed = place_frames(recording, result);
      Panel panel;
      panel.title = pipeline + ": " + counted(result->map.lines.size(), "line");
      panel.items.emplace_back(Points{.points = all_points(recording, placed.world_from_sensor, kPointBudget / maps),
                                      .color = kFaintPoints,
                                      .size_pt = 0.8});
      Lines lines{.stroke = {method_color(input.results, i), 1.2, Dash::solid}};
      if (swatches.empty() || swatches.back().stroke->color != lines.stroke.color)
        swatches.push_back({.text = "map of " + pipeline, .stroke = lines.stroke});
      Points tips{.marker = Marker::circle, .color = lines.stroke.color, .size_pt = 2.4};
      for (const MapLine& line : result->map.lines) {
        lines.segments.push_back(line.segment);
        tips.points.insert(tips.points.end(), {line.segment.a, line.segment.b});
      }
      panel.items.emplace_back(std::move(lines));
      if (most_lines <= kMostLinesWithEnds) panel.items.emplace_back(std::move(tips));
      add_path(input, placed.world_from_sensor, path_stroke, panel);
      if (!recording.truth) set_robust_ranges(panel, std::get<Points>(panel.items[0]).points);
      scene.panels.push_back(std::move(panel));
    }
    scene.legend.push_back(
        {.text = "points of all scans", .marker = Marker::dot, .marker_color = kFaintPoints, .marker_size_pt = 2.0});
    if (swatches.size() == 1) swatches.front().text = "lines of the map";
    scene.legend.insert(scene.legend.end(), swatches.begin(), swatches.end());
    scene.legend.push_back(path_legend(input, path_stroke));
    return {{"map", input.title + ": the line map of each pipeline over the points of all scans.", std::move(scene)}};
  }
};

const bool registered = Registry<Figure>::add<Map>(
    {.name = "map", .summary = "the line map of each pipeline over the points of all scans", .reference = ""});

}  // namespace
}  // namespace scanbench::render
