// Frames of a recording in the world: their poses, points and walls.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/recording.hpp"
#include "core/result.hpp"

namespace scanbench::render {

/// The index of the frame to show: `wanted`; the middle one for -1; the last one if there is no frame `wanted`. The
/// recording must have frames.
std::size_t shown_frame(const Recording& recording, int wanted);

/// True if the poses differ by more than the rounding of files.
bool differ(std::span<const Pose2> a, std::span<const Pose2> b);

enum class PoseSource { aligned, odometry, truth, recorded };
std::string to_string(PoseSource source);  ///< "as aligned", "odometry", "true poses", "recorded poses"

/// World poses of all frames: the result's, if it has any (`aligned` if they differ from the recording's own); else the
/// true ones; else those of the log. `result` may be nullptr.
struct PlacedFrames {
  PoseSource source = PoseSource::recorded;
  std::vector<Pose2> world_from_sensor;
};
PlacedFrames place_frames(const Recording& recording, const PipelineResult* result);

/// World points of the valid returns of one frame, sensor frame if the pose is the identity.
std::vector<Vec2> frame_points(const Recording& recording, std::size_t frame, const Pose2& world_from_sensor);

/// An even selection of at most `budget` points from the valid returns of all frames.
std::vector<Vec2> all_points(const Recording& recording, std::span<const Pose2> world_from_sensor, std::size_t budget);

/// True walls as seen from a frame (identity: world frame); empty without truth.
std::vector<Segment> true_walls(const Recording& recording, const Pose2& frame_from_world);

}  // namespace scanbench::render
