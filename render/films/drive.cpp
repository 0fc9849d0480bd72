// A robot that drives and scans: its path so far, the returns of each scan and the lines found in it.
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "core/registry.hpp"
#include "render/figures/parts/frames.hpp"
#include "render/figures/parts/style.hpp"
#include "render/figures/parts/view_box.hpp"
#include "render/film.hpp"
#include "render/films/stage.hpp"

namespace scanbench::render {
namespace {

constexpr std::size_t kBackgroundPoints = 2500;
const Stroke kWalls{kTruthUnderlay, 2.2, Dash::solid};
const Stroke kDrivePath{kPathColor, 0.8, Dash::solid};

class Drive final : public FilmKind {
 public:
  using Params = NoParams;
  explicit Drive(const Params&) {}

  std::optional<Film> make(const FigureInput& input, std::size_t most) const override {
    const Recording& recording = input.recording;
    const std::size_t frames = recording.observed.frames.size();
    if (frames == 0 || recording.observed.sensor.geometry.beams() == 0 || input.results.empty()) return std::nullopt;
    const NamedResult& shown = input.results.front();
    const auto steps = chosen_steps(frames, most);
    // Scans are drawn where they were taken, not where a pipeline placed them.
    const auto poses = std::make_shared<const std::vector<Pose2>>(place_frames(recording, nullptr).world_from_sensor);
    const auto ground = std::make_shared<const Panel>(background(recording, *poses));
    const Stroke found{method_color(input.results, 0), 1.4, Dash::solid};
    const auto scene = [&input, &shown, steps, poses, ground, found, frames](std::size_t k) {
      const std::size_t f = steps[k];
      Panel panel = *ground;
      panel.title = fmt::format("{}: scan {} (0 to {})", shown.pipeline, f, frames - 1);
      add_path(input, std::span(*poses).first(f + 1), kDrivePath, panel);
      const Pose2& pose = (*poses)[f];
      panel.items.emplace_back(
          Points{.points = frame_points(input.recording, f, pose), .color = kScanColor, .size_pt = 1.6});
      if (f < shown.result->lines.size()) {
        Lines lines{.segments = {}, .stroke = found};
        for (const LineFeature& line : shown.result->lines[f].lines) lines.segments.push_back(pose * line.segment);
        panel.items.emplace_back(std::move(lines));
      }
      panel.items.emplace_back(Arrow{.pose = pose, .length_pt = 14, .stroke = {kPathColor, 1.2, Dash::solid}});
      std::vector<LegendEntry> legend;
      if (input.recording.truth) legend.push_back({.text = "walls", .stroke = kWalls});
      legend.push_back({.text = "scan", .marker = Marker::dot, .marker_color = kScanColor, .marker_size_pt = 2.4});
      legend.push_back({.text = "lines of " + shown.pipeline, .stroke = found});
      legend.push_back(path_legend(input, kDrivePath));
      return film_scene(input.title, {std::move(panel)}, std::move(legend));
    };
    return Film{steps.size(), scene,
                fmt::format("{}: {} scans at their {}, and the lines that {} found in them.", input.title, frames,
                            to_string(place_frames(recording, nullptr).source), shown.pipeline)};
  }

 private:
  /// The walls, or without a truth the points of all scans, and the range of all frames.
  static Panel background(const Recording& recording, const std::vector<Pose2>& poses) {
    Panel panel;
    std::vector<Vec2> places;
    places.reserve(poses.size());
    for (const Pose2& pose : poses) places.push_back(pose.translation());
    const std::vector<Segment> walls = true_walls(recording, Pose2());
    const std::vector<Vec2> points = all_points(recording, poses, kBackgroundPoints);
    if (walls.empty())
      panel.items.emplace_back(Points{.points = points, .color = kFaintPoints, .size_pt = 0.8});
    else
      panel.items.emplace_back(Lines{walls, kWalls});
    for (const Vec2& end : ends_of(walls)) places.push_back(end);
    set_view(points, places, panel);
    return panel;
  }
};

SCANBENCH_REGISTER(FilmKind, Drive,
                   {.name = "drive",
                    .summary = "the robot, its path, its scans and the lines found in them",
                    .reference = ""});

}  // namespace
}  // namespace scanbench::render
