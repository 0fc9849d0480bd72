// The world and one scan of it: walls with their labels, the path, the waypoints, the returns at one pose. For a
// recorded log the points of all scans replace the walls.
#include <fmt/format.h>

#include <cmath>

#include "core/registry.hpp"
#include "render/figures/parts/frames.hpp"
#include "render/figures/parts/style.hpp"
#include "render/figures/parts/view_box.hpp"

namespace scanbench::render {
namespace {

constexpr std::size_t kMostLabels = 60;  // more cannot be read at a column's width

class Environment : public Figure {
 public:
  struct Params {
    int frame = -1;
    double width_in = kSingleColumnIn;
    bool scan = true;
    static auto fields() {
      return std::tuple{
          field("frame", &Params::frame, at_least(-1), "", "frame whose scan is shown, from 0; -1: the middle one"),
          field("width_in", &Params::width_in, between(2, 20), "in", "width on paper: 3.5 one column, 7.16 two"),
          field("scan", &Params::scan, "show the points of one scan and its pose")};
    }
  };
  explicit Environment(const Params& params) : params_(params) {}

  std::string why_nothing(const FigureInput&) const override { return "the recording has neither scans nor walls"; }

  std::vector<NamedScene> draw(const FigureInput& input) const override {
    const Recording& recording = input.recording;
    const bool has_frames = !recording.observed.frames.empty();
    const bool has_walls = recording.truth && !recording.truth->walls.empty();
    if (!has_frames && !has_walls) return {};
    Scene scene{.width_in = params_.width_in, .title = input.title, .scale_bar = true};
    Panel panel{.tell_outside = "point"};
    std::string caption = input.title + ":";
    std::vector<Vec2> seen;  // of the scan that is shown

    const PlacedFrames placed = place_frames(recording, nullptr);
    if (has_walls) {
      const bool labels = recording.truth->walls.size() <= kMostLabels;
      add_walls(*recording.truth, labels, panel, scene);
      add_distractors(input, panel, scene);
      caption += labels ? " walls with their labels" : " walls";
    } else {
      const std::vector<Vec2> points = all_points(recording, placed.world_from_sensor, kPointBudget);
      set_view(points, {}, panel);
      panel.items.emplace_back(Points{.points = points, .color = kFaintPoints, .size_pt = 0.8});
      scene.legend.push_back(
          {.text = "points of all scans", .marker = Marker::dot, .marker_color = kFaintPoints, .marker_size_pt = 2.0});
      caption += " points of all scans";
    }
    if (has_frames) {
      const Stroke stroke{kPathColor, 0.7, Dash::solid};
      add_path(input, placed.world_from_sensor, stroke, panel);
      scene.legend.push_back(path_legend(input, stroke));
      caption += fmt::format(", {} of {} scans", to_string(placed.source), recording.observed.frames.size());
    }
    if (has_frames && params_.scan) {
      const std::size_t frame = shown_frame(recording, params_.frame);
      seen = frame_points(recording, frame, placed.world_from_sensor[frame]);
      add_scan(seen, placed.world_from_sensor[frame], panel, scene);
      caption += fmt::format(", and the returns of scan {} with the pose of the sensor", frame);
    }
    add_waypoints(input.waypoints, panel, scene);
    if (has_walls) set_view(seen, world_of(input, placed), panel);
    scene.panels.push_back(std::move(panel));
    return {{"environment", caption + ".", std::move(scene)}};
  }

 private:
  static void add_walls(const Truth& truth, bool labels, Panel& panel, Scene& scene) {
    Lines walls{.stroke = {kWallColor, 1.2, Dash::solid}};
    for (const Wall& wall : truth.walls) walls.segments.push_back(wall.segment);
    panel.items.emplace_back(std::move(walls));
    scene.legend.push_back({.text = "walls", .stroke = Stroke{kWallColor, 1.2, Dash::solid}});
    if (!labels) return;
    for (const Wall& wall : truth.walls) {
      const Vec2 behind = -perpendicular(wall.segment.direction());  // free space is on the left
      panel.items.emplace_back(Text{.at = wall.segment.midpoint(), .text = wall.label, .offset_pt = 2.6 * behind});
    }
  }

  static void add_distractors(const FigureInput& input, Panel& panel, Scene& scene) {
    const Stroke round{kWallColor, 0.8, Dash::solid}, moving{kGrey, 0.8, Dash::dashed};
    for (const RoundObject& thing : input.circles) {
      Polyline circle{.stroke = round, .closed = true};
      for (int k = 0; k < 48; ++k) {
        const double angle = 2 * kPi * k / 48;
        circle.points.emplace_back(thing.center + thing.radius_m * Vec2(std::cos(angle), std::sin(angle)));
      }
      panel.items.emplace_back(std::move(circle));
    }
    for (const std::vector<Vec2>& path : input.body_paths)
      panel.items.emplace_back(Polyline{.points = path, .stroke = moving});
    if (!input.body_paths.empty()) scene.legend.push_back({.text = "path of a moving body", .stroke = moving});
  }

  /// Points that the view must contain; returns far away from them may be outside.
  static std::vector<Vec2> world_of(const FigureInput& input, const PlacedFrames& placed) {
    std::vector<Vec2> world = ends_of(true_walls(input.recording, Pose2()));
    for (const Pose2& pose : placed.world_from_sensor) world.push_back(pose.translation());
    for (const auto& [name, point] : input.waypoints) world.push_back(point);
    for (const RoundObject& thing : input.circles)
      for (const Vec2& corner : {Vec2(thing.radius_m, thing.radius_m), Vec2(-thing.radius_m, -thing.radius_m)})
        world.emplace_back(thing.center + corner);
    for (const std::vector<Vec2>& path : input.body_paths) world.insert(world.end(), path.begin(), path.end());
    return world;
  }

  static void add_scan(const std::vector<Vec2>& points, const Pose2& pose, Panel& panel, Scene& scene) {
    panel.items.emplace_back(Points{.points = points, .color = kScanColor, .size_pt = 1.5});
    panel.items.emplace_back(Arrow{.pose = pose, .length_pt = 15, .stroke = {kScanColor, 1.0, Dash::solid}});
    scene.legend.push_back(
        {.text = "one scan", .marker = Marker::dot, .marker_color = kScanColor, .marker_size_pt = 2.4});
    scene.legend.push_back({.text = "its pose", .stroke = Stroke{kScanColor, 1.0, Dash::solid}, .arrow = true});
  }

  static void add_waypoints(const NamedPoints& waypoints, Panel& panel, Scene& scene) {
    if (waypoints.empty()) return;
    Points marks{.marker = Marker::circle, .color = kPathColor, .size_pt = 4.2, .filled = false};
    for (const auto& [name, point] : waypoints) marks.points.push_back(point);
    panel.items.emplace_back(std::move(marks));
    for (const auto& [name, point] : waypoints)
      panel.items.emplace_back(Text{.at = point, .text = name, .offset_pt = {2.8, 2.8}, .color = kPathColor});
    scene.legend.push_back({.text = "waypoints",
                            .marker = Marker::circle,
                            .marker_color = kPathColor,
                            .marker_size_pt = 4.2,
                            .marker_filled = false});
  }

  Params params_;
};

SCANBENCH_REGISTER(Figure, Environment,
                   {.name = "environment",
                    .summary = "walls with labels, trajectory, waypoints and one scan",
                    .reference = ""});

}  // namespace
}  // namespace scanbench::render
