// What the figures share: where frames stand in the world, their points, and the looks of recurring things.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render/figure.hpp"
#include "render/palette.hpp"

namespace scanbench::render {

/// Looks that are the same in every figure.
inline constexpr Color kWallColor = kBlack;
inline constexpr Color kScanColor = kBlue;
inline constexpr Color kPathColor = kVermillion;
inline const Color kTruthUnderlay{205, 205, 205};  ///< true walls behind coloured lines
inline const Color kFaintPoints{175, 175, 175};
inline constexpr double kPlaceSizePt = 3.0;

/// How many segments or points all panels of one figure may show: an SVG of them stays below a megabyte.
inline constexpr std::size_t kSegmentBudget = 14000;
inline constexpr std::size_t kPointBudget = 9000;

/// The frame to show: `wanted`, -1 for the middle one, the last one if there are fewer. The recording has frames.
std::size_t shown_frame(const Recording& recording, int wanted);

/// By more than a file of numbers may round.
bool differ(std::span<const Pose2> a, std::span<const Pose2> b);

enum class PoseSource { aligned, odometry, truth, recorded };
std::string to_string(PoseSource source);  ///< "as aligned", "odometry", "true poses", "recorded poses"

/// World poses of all frames: those of the result if it has any, aligned if they are not the recording's own, else true
/// ones, else those of the log. `result` may be nullptr.
struct PlacedFrames {
  PoseSource source = PoseSource::recorded;
  std::vector<Pose2> world_from_sensor;
};
PlacedFrames place_frames(const Recording& recording, const PipelineResult* result);

/// World points of the valid returns of one frame, sensor frame if the pose is the identity.
std::vector<Vec2> frame_points(const Recording& recording, std::size_t frame, const Pose2& world_from_sensor);

/// At most `budget` points, evenly taken from the valid returns of all frames.
std::vector<Vec2> all_points(const Recording& recording, std::span<const Pose2> world_from_sensor, std::size_t budget);

/// The way of the sensor as a line, and its legend entry; dots where it was put down at each pose.
void add_path(const FigureInput& input, std::span<const Pose2> poses, const Stroke& stroke, Panel& panel);
LegendEntry path_legend(const FigureInput& input, const Stroke& stroke);

/// True walls as seen from a frame (identity: world frame); empty without truth.
std::vector<Segment> true_walls(const Recording& recording, const Pose2& frame_from_world);

/// Axis ranges of the bulk of the points: a few far outliers do not shrink the rest. Absent if the points are few or
/// have no outliers.
void set_robust_ranges(Panel& panel, const std::vector<Vec2>& points);

/// Ranges that hold the points with a margin, where set_robust_ranges() set none. Without finite points: none.
void set_ranges_to_hold(Panel& panel, const std::vector<Vec2>& points);

/// How many methods have a colour each; more share one, for their panels tell them apart.
inline constexpr std::size_t kColoredMethods = 4;

/// The colour of method i of the results: what add_method_legend() says.
Color method_color(const std::vector<NamedResult>& results, std::size_t i);

/// A swatch per method in its colour; one for all, "lines found", if there are more than four.
void add_method_legend(const std::vector<NamedResult>& results, double width_pt, Scene& scene);

/// A scene of small multiples for `panels` panels: width and columns.
Scene small_multiples(std::size_t panels);

/// Does a figure whose parameter `pipeline` is `wanted` (empty: any) show this one?
inline bool shows(std::string_view wanted, std::string_view pipeline) {
  return wanted.empty() || wanted == pipeline;
}

/// "1 line", "3 lines".
std::string counted(std::size_t n, const std::string& noun);

}  // namespace scanbench::render
