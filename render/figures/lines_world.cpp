// All lines of all frames, placed in the world by the poses that the pipeline had: small multiples.
#include <fmt/format.h>

#include "core/registry.hpp"
#include "render/figures/parts/frames.hpp"
#include "render/figures/parts/looks.hpp"
#include "render/figures/parts/view_box.hpp"

namespace scanbench::render {
namespace {

class LinesWorld : public Figure {
 public:
  using Params = NoParams;
  explicit LinesWorld(const Params&) {}

  std::vector<NamedScene> draw(const FigureInput& input) const override {
    const Recording& recording = input.recording;
    std::size_t total = 0;
    for (const NamedResult& named : input.results)
      for (const ScanLines& lines : named.result->lines) total += lines.lines.size();
    if (recording.observed.frames.empty() || total == 0) return {};
    const std::size_t stride = (total + kSegmentBudget - 1) / kSegmentBudget;

    Scene scene = small_multiples(input.results.size());
    scene.title = input.title + ": lines of all scans";
    const Stroke wall_stroke{kWallColor, 0.35, Dash::solid}, path_stroke{kGrey, 0.5, Dash::dotted};
    std::vector<Vec2> ends;
    for (std::size_t i = 0; i < input.results.size(); ++i) {
      const std::string& pipeline = input.results[i].pipeline;
      const PipelineResult* result = input.results[i].result;
      const PlacedFrames placed = place_frames(recording, result);
      Panel panel;
      add_path(input, placed.world_from_sensor, path_stroke, panel);
      Lines lines{.stroke = {method_color(input.results, i), 0.6, Dash::solid}};
      std::size_t found = 0;
      for (std::size_t f = 0; f < std::min(result->lines.size(), placed.world_from_sensor.size()); ++f) {
        found += result->lines[f].lines.size();
        if (f % stride != 0) continue;
        for (const LineFeature& line : result->lines[f].lines)
          lines.segments.push_back(placed.world_from_sensor[f] * line.segment);
      }
      for (const Segment& s : lines.segments) ends.insert(ends.end(), {s.a, s.b});
      panel.title = fmt::format("{}: {}, {}", pipeline, counted(found, "line"), to_string(placed.source));
      panel.items.emplace_back(std::move(lines));
      if (recording.truth) panel.items.emplace_back(Lines{true_walls(recording, Pose2()), wall_stroke});
      scene.panels.push_back(std::move(panel));
    }
    if (!recording.truth)
      for (Panel& panel : scene.panels) set_robust_ranges(panel, ends);
    if (recording.truth) scene.legend.push_back({.text = "true walls", .stroke = wall_stroke});
    add_method_legend(input.results, 0.9, scene);
    scene.legend.push_back(path_legend(input, path_stroke));
    const std::string thinned = stride > 1 ? fmt::format(" Only one scan in {} is drawn.", stride) : "";
    return {{"lines_world",
             input.title + ": the lines found in all scans, placed by the poses of each pipeline." + thinned,
             std::move(scene)}};
  }
};

const bool registered = Registry<Figure>::add<LinesWorld>(
    {.name = "lines_world", .summary = "the lines of all scans, placed in the world", .reference = ""});

}  // namespace
}  // namespace scanbench::render
