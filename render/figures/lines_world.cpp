// All lines of all frames, placed in the world by the poses that the pipeline used: small multiples.
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/registry.hpp"
#include "render/figures/parts/frames.hpp"
#include "render/figures/parts/judged_lines.hpp"
#include "render/figures/parts/style.hpp"
#include "render/figures/parts/view_box.hpp"

namespace scanbench::render {
namespace {

const Stroke kThinWallStroke{kWallColor, 0.35, Dash::solid};
const Stroke kWorldPathStroke{kGrey, 0.5, Dash::dotted};
constexpr double kWorldLineWidth = 0.6;

class LinesWorld : public Figure {
 public:
  using Params = NoParams;
  explicit LinesWorld(const Params&) {}

  std::string why_nothing(const FigureInput&) const override { return "no pipeline has lines"; }

  std::vector<NamedScene> draw(const FigureInput& input) const override {
    const Recording& recording = input.recording;
    std::size_t total = 0;
    for (const NamedResult& named : input.results)
      for (const ScanLines& lines : named.result->lines) total += lines.lines.size();
    if (recording.observed.frames.empty() || total == 0) return {};
    const std::size_t stride = (total + kSegmentBudget - 1) / kSegmentBudget;
    const auto groups = groups_of_equal(input.results.size(), [&](std::size_t i, std::size_t k) {
      return placed_lines(input, i, 1) == placed_lines(input, k, 1);
    });

    Scene scene = small_multiples(groups.size());
    scene.title = input.title + ": lines of all scans";
    const std::vector<Vec2> wall_ends = ends_of(true_walls(recording, Pose2()));
    bool judged = false;
    for (const auto& group : groups) {
      const NamedResult& named = input.results[group.front()];
      const PlacedFrames placed = place_frames(recording, named.result);
      const JudgedLines lines = placed_lines(input, group.front(), stride);
      judged = judged || !named.verdicts.empty();
      std::size_t found = 0;
      for (const ScanLines& scan : named.result->lines) found += scan.lines.size();
      Panel panel{.tell_outside = "line"};
      panel.title =
          fmt::format("{}: {}, {}", names_of(input.results, group), counted(found, "line"), to_string(placed.source));
      add_path(input, placed.world_from_sensor, kWorldPathStroke, panel);
      lines.draw({method_color(input.results, group.front()), kWorldLineWidth, Dash::solid}, false, panel);
      if (recording.truth) panel.items.emplace_back(Lines{true_walls(recording, Pose2()), kThinWallStroke});
      set_view(ends_of(lines.found()), wall_ends, panel);
      scene.panels.push_back(std::move(panel));
    }
    if (recording.truth) scene.legend.push_back({.text = "true walls", .stroke = kThinWallStroke});
    if (judged)
      add_verdict_legend(kWorldLineWidth, scene);
    else
      add_method_legend(input.results, groups, 0.9, scene);
    scene.legend.push_back(path_legend(input, kWorldPathStroke));
    const std::string thinned = stride > 1 ? fmt::format(" Only one scan in {} is drawn.", stride) : "";
    return {{"lines_world",
             input.title + ": the lines found in all scans, placed by the poses of each pipeline." + thinned,
             std::move(scene)}};
  }

 private:
  /// The lines of every `stride`-th scan, in the world frame.
  static JudgedLines placed_lines(const FigureInput& input, std::size_t i, std::size_t stride) {
    const NamedResult& named = input.results[i];
    const PlacedFrames placed = place_frames(input.recording, named.result);
    JudgedLines lines;
    for (std::size_t f = 0; f < std::min(named.result->lines.size(), placed.world_from_sensor.size()); f += stride)
      lines.add(named.result->lines[f], named.verdicts, f, placed.world_from_sensor[f]);
    return lines;
  }
};

SCANBENCH_REGISTER(Figure, LinesWorld,
                   {.name = "lines_world", .summary = "the lines of all scans, placed in the world", .reference = ""});

}  // namespace
}  // namespace scanbench::render
