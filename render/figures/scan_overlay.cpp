// One scan and over it the lines that each pipeline found in it: small multiples in the sensor frame.
#include <fmt/format.h>

#include "core/registry.hpp"
#include "render/figures/parts/frames.hpp"
#include "render/figures/parts/looks.hpp"
#include "render/figures/parts/view_box.hpp"

namespace scanbench::render {
namespace {

class ScanOverlay : public Figure {
 public:
  struct Params {
    int frame = -1;
    static auto fields() {
      return std::tuple{field("frame", &Params::frame, at_least(-1), "", "frame to show, from 0; -1: the middle one")};
    }
  };
  explicit ScanOverlay(const Params& params) : params_(params) {}

  std::vector<NamedScene> draw(const FigureInput& input) const override {
    const Recording& recording = input.recording;
    if (recording.observed.frames.empty() || input.results.empty()) return {};
    const std::size_t frame = shown_frame(recording, params_.frame);
    const std::vector<Vec2> points = frame_points(recording, frame, Pose2());
    const bool has_truth = recording.truth && frame < recording.truth->world_from_sensor.size();

    Scene scene = small_multiples(input.results.size());
    scene.title = fmt::format("{}: scan {} of {}", input.title, frame + 1, recording.observed.frames.size());
    const Stroke wall_stroke{kTruthUnderlay, 2.6, Dash::solid};
    for (std::size_t i = 0; i < input.results.size(); ++i) {
      const std::string& pipeline = input.results[i].pipeline;
      const PipelineResult* result = input.results[i].result;
      Panel panel;
      if (has_truth)
        panel.items.emplace_back(
            Lines{true_walls(recording, recording.truth->world_from_sensor[frame].inverse()), wall_stroke});
      panel.items.emplace_back(Points{.points = points, .color = kBlack, .size_pt = 1.1});
      Lines lines{.stroke = {method_color(input.results, i), 1.3, Dash::solid}};
      if (frame < result->lines.size())
        for (const LineFeature& line : result->lines[frame].lines) lines.segments.push_back(line.segment);
      panel.title = pipeline + ": " + counted(lines.segments.size(), "line");
      // Dots at the ends show where a line was split.
      Points ends{.marker = Marker::circle, .color = lines.stroke.color, .size_pt = 2.8};
      for (const Segment& s : lines.segments) ends.points.insert(ends.points.end(), {s.a, s.b});
      panel.items.emplace_back(std::move(lines));
      panel.items.emplace_back(std::move(ends));
      panel.items.emplace_back(Arrow{.pose = Pose2(), .length_pt = 12, .stroke = {kGrey, 0.9, Dash::solid}});
      scene.panels.push_back(std::move(panel));
    }
    set_ranges(points, scene);
    if (has_truth) scene.legend.push_back({.text = "true walls", .stroke = wall_stroke});
    scene.legend.push_back({.text = "scan points", .marker = Marker::dot, .marker_size_pt = 2.0});
    add_method_legend(input.results, 1.3, scene);
    scene.legend.push_back({.text = "sensor", .stroke = Stroke{kGrey, 0.9, Dash::solid}, .arrow = true});
    return {{"scan_overlay",
             fmt::format("{}: the points of scan {} and the lines that each pipeline found in it, sensor frame.",
                         input.title, frame + 1),
             std::move(scene)}};
  }

 private:
  /// The view holds what was seen and said, not walls far away.
  static void set_ranges(const std::vector<Vec2>& points, Scene& scene) {
    for (Panel& panel : scene.panels) {
      set_robust_ranges(panel, points);
      std::vector<Vec2> shown = points;
      shown.emplace_back(0.0, 0.0);
      set_ranges_to_hold(panel, shown);
    }
  }

  Params params_;
};

const bool registered = Registry<Figure>::add<ScanOverlay>(
    {.name = "scan_overlay", .summary = "one scan and the lines each pipeline found in it", .reference = ""});

}  // namespace
}  // namespace scanbench::render
