// Figure 8 of Lakaemper 2009: the points of all scans, superimposed by odometry (or as given), by the poses that a
// pipeline used, and by the true ones or those that a log has to compare with.
#include <algorithm>

#include <fmt/format.h>

#include "core/registry.hpp"
#include "render/figures/parts/clusters.hpp"
#include "render/figures/parts/frames.hpp"
#include "render/figures/parts/style.hpp"
#include "render/figures/parts/view_box.hpp"

namespace scanbench::render {
namespace {

constexpr std::size_t kMostColored = 40;  // the colours of more scans mix to grey

/// Beside scans in all colours the sensor is grey, which is the colour of none of them.
Stroke path_stroke(std::size_t scans) {
  return {scans <= kMostColored ? kGrey : kPathColor, 0.7, Dash::solid};
}

class Alignment : public Figure {
 public:
  struct Params {
    std::string pipeline;
    bool every_pipeline = false;
    static auto fields() {
      return std::tuple{
          field("pipeline", &Params::pipeline,
                "pipeline whose poses are shown; empty: the first one that changes the poses"),
          field("every_pipeline", &Params::every_pipeline,
                "a panel for every pipeline that gives poses, not only for the first one that changes them")};
    }
  };
  explicit Alignment(const Params& params) : params_(params) {}

  std::string why_nothing(const FigureInput&) const override { return "the recording has no scans"; }

  std::vector<NamedScene> draw(const FigureInput& input) const override {
    const auto& frames = input.recording.observed.frames;
    if (frames.empty()) return {};
    std::vector<Pose2> odometry;
    odometry.reserve(frames.size());
    for (const Frame& frame : frames) odometry.push_back(frame.odom_from_sensor);

    Scene scene;
    std::vector<const NamedResult*> aligned;
    for (const NamedResult& r : input.results) {
      if (!aligned.empty() && !params_.every_pipeline) break;
      if (shows(params_.pipeline, r.pipeline) && r.result->world_from_sensor.size() == frames.size() &&
          (params_.every_pipeline || differ(r.result->world_from_sensor, odometry)))
        aligned.push_back(&r);
    }
    const auto& reference = input.recording.reference;
    const bool compared = reference && reference->world_from_sensor.size() == frames.size();
    const std::size_t most = std::max<std::size_t>(aligned.size(), 1) + (input.recording.truth || compared ? 2 : 1);
    add_panel(input, input.recording.truth ? "odometry" : "given poses", odometry, most, scene);
    for (const NamedResult* r : aligned)
      add_panel(input,
                (differ(r->result->world_from_sensor, odometry) ? "as aligned: " : "left as given: ") + r->pipeline,
                r->result->world_from_sensor, most, scene);
    if (input.recording.truth && input.recording.truth->world_from_sensor.size() == frames.size())
      add_panel(input, "true poses", input.recording.truth->world_from_sensor, most, scene);
    if (compared) add_panel(input, "poses to compare with", reference->world_from_sensor, most, scene);

    std::string sources;
    for (const Panel& panel : scene.panels) sources += (sources.empty() ? "" : "; ") + panel.title;
    arrange_multiples(scene);
    scene.title = fmt::format("{}: {} superimposed", input.title, counted(frames.size(), "scan"));
    scene.legend = {{.text = frames.size() <= kMostColored ? "points, a colour for each scan" : "points",
                     .marker = Marker::dot,
                     .marker_color = kScanColor,
                     .marker_size_pt = 2.4},
                    path_legend(input, path_stroke(frames.size()))};
    return {
        {"alignment",
         fmt::format("{}: the points of {} superimposed: {}.", input.title, counted(frames.size(), "scan"), sources),
         std::move(scene)}};
  }

 private:
  static void add_panel(const FigureInput& input, const std::string& title, const std::vector<Pose2>& poses,
                        std::size_t panels, Scene& scene) {
    const Recording& recording = input.recording;
    Panel panel{.title = fmt::format("{}) {}", static_cast<char>('a' + scene.panels.size()), title),
                .tell_outside = "point"};
    std::vector<Vec2> points, places;  // of a few scans, the view also holds the places of the sensor
    if (poses.size() <= kMostColored) {
      // Neighbours along the path overlap most, so their colours differ most.
      places.reserve(poses.size());
      for (const Pose2& pose : poses) places.push_back(pose.translation());
      const std::vector<Color> colors = cluster_colors(places);
      const std::size_t budget = kPointBudget / panels / poses.size();
      for (std::size_t f = 0; f < poses.size(); ++f) {
        std::vector<Vec2> scan = frame_points(recording, f, poses[f]);
        Points shown{.color = colors[f], .size_pt = 0.9};
        for (std::size_t k = 0; k < scan.size(); k += scan.size() / budget + 1) shown.points.push_back(scan[k]);
        points.insert(points.end(), scan.begin(), scan.end());
        panel.items.emplace_back(std::move(shown));
      }
    } else {
      points = all_points(recording, poses, kPointBudget / panels);
      panel.items.emplace_back(Points{.points = points, .color = kScanColor, .size_pt = 0.7});
    }
    add_path(input, poses, path_stroke(poses.size()), panel);
    set_view(points, places, panel);
    if (points.empty()) add_note("no scan points", panel);
    scene.panels.push_back(std::move(panel));
  }

  Params params_;
};

SCANBENCH_REGISTER(
    Figure, Alignment,
    {.name = "alignment",
     .summary =
         "points of all scans, superimposed by odometry, by the poses that a pipeline used, and by the true ones "
         "or those that a log has to compare with",
     .reference = "Lakaemper 2009, figure 8"});

}  // namespace
}  // namespace scanbench::render
