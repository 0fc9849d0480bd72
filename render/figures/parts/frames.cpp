// Places the scans of a recording by the poses of a result or of the recording.
#include "render/figures/parts/frames.hpp"

#include <algorithm>
#include <cmath>

namespace scanbench::render {

std::size_t shown_frame(const Recording& recording, int wanted) {
  const std::size_t frames = recording.observed.frames.size();
  return wanted < 0 ? frames / 2 : std::min(static_cast<std::size_t>(wanted), frames - 1);
}

std::string to_string(PoseSource source) {
  switch (source) {
    case PoseSource::aligned:
      return "as aligned";
    case PoseSource::odometry:
      return "odometry";
    case PoseSource::truth:
      return "true poses";
    default:
      return "recorded poses";
  }
}

bool differ(std::span<const Pose2> a, std::span<const Pose2> b) {
  return !std::ranges::equal(a, b, [](const Pose2& p, const Pose2& q) {
    const Pose2 step = p.inverse() * q;
    return step.translation().norm() < 1e-9 && std::abs(step.yaw()) < 1e-9;
  });
}

PlacedFrames place_frames(const Recording& recording, const PipelineResult* result) {
  const std::size_t frames = recording.observed.frames.size();
  std::vector<Pose2> own;
  for (const Frame& frame : recording.observed.frames) own.push_back(frame.odom_from_sensor);
  const PoseSource source = recording.truth ? PoseSource::odometry : PoseSource::recorded;
  if (result != nullptr && frames > 0 && result->world_from_sensor.size() == frames)
    return {differ(result->world_from_sensor, own) ? PoseSource::aligned : source, result->world_from_sensor};
  if (recording.truth && recording.truth->world_from_sensor.size() == frames)
    return {PoseSource::truth, recording.truth->world_from_sensor};
  return {source, std::move(own)};
}

std::vector<Vec2> frame_points(const Recording& recording, std::size_t frame, const Pose2& world_from_sensor) {
  const Scan scan = recording.observed.scan(frame);
  std::vector<Vec2> points;
  for (int beam = 0; beam < scan.beams(); ++beam)
    if (scan.valid(beam)) points.push_back(world_from_sensor * scan.point(beam));
  return points;
}

std::vector<Vec2> all_points(const Recording& recording, std::span<const Pose2> world_from_sensor, std::size_t budget) {
  std::size_t total = 0;
  for (std::size_t f = 0; f < world_from_sensor.size(); ++f) {
    const Scan scan = recording.observed.scan(f);
    for (int beam = 0; beam < scan.beams(); ++beam) total += scan.valid(beam) ? 1 : 0;
  }
  const std::size_t stride = std::max<std::size_t>(1, (total + budget - 1) / std::max<std::size_t>(1, budget));
  std::vector<Vec2> points;
  std::size_t k = 0;
  for (std::size_t f = 0; f < world_from_sensor.size(); ++f) {
    const Scan scan = recording.observed.scan(f);
    for (int beam = 0; beam < scan.beams(); ++beam)
      if (scan.valid(beam) && k++ % stride == 0) points.push_back(world_from_sensor[f] * scan.point(beam));
  }
  return points;
}

std::vector<Segment> true_walls(const Recording& recording, const Pose2& frame_from_world) {
  std::vector<Segment> walls;
  if (recording.truth)
    for (const Wall& wall : recording.truth->walls) walls.push_back(frame_from_world * wall.segment);
  return walls;
}

}  // namespace scanbench::render
