#include "render/figures/parts/common.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

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

void add_path(const FigureInput& input, std::span<const Pose2> poses, const Stroke& stroke, Panel& panel) {
  std::vector<Vec2> places;
  for (const Pose2& pose : poses) places.push_back(pose.translation());
  if (input.continuous)
    panel.items.emplace_back(Polyline{.points = std::move(places), .stroke = stroke});
  else
    panel.items.emplace_back(Points{.points = std::move(places), .color = stroke.color, .size_pt = kPlaceSizePt});
}

LegendEntry path_legend(const FigureInput& input, const Stroke& stroke) {
  if (input.continuous) return {.text = "path of the sensor", .stroke = stroke};
  return {.text = "places of the sensor",
          .marker = Marker::dot,
          .marker_color = stroke.color,
          .marker_size_pt = kPlaceSizePt};
}

std::vector<Segment> true_walls(const Recording& recording, const Pose2& frame_from_world) {
  std::vector<Segment> walls;
  if (recording.truth)
    for (const Wall& wall : recording.truth->walls) walls.push_back(frame_from_world * wall.segment);
  return walls;
}

void set_robust_ranges(Panel& panel, const std::vector<Vec2>& points) {
  if (points.size() < 200) return;
  const auto bulk = [&](Axis& axis, int coordinate) {
    std::vector<double> v;
    for (const Vec2& p : points)
      if (std::isfinite(p[coordinate])) v.push_back(p[coordinate]);
    if (v.size() < 200) return;
    std::sort(v.begin(), v.end());
    const auto quantile = [&](double q) { return v[static_cast<std::size_t>(q * static_cast<double>(v.size() - 1))]; };
    const double low = quantile(0.005), high = quantile(0.995), room = 0.1 * (high - low);
    if (v.back() - v.front() > 1.6 * (high - low) && high > low)
      axis.range = {std::max(v.front(), low - room), std::min(v.back(), high + room)};
  };
  bulk(panel.x, 0);
  bulk(panel.y, 1);
}

void set_ranges_to_hold(Panel& panel, const std::vector<Vec2>& points) {
  Vec2 low(INFINITY, INFINITY), high = -low;
  for (const Vec2& p : points)
    if (p.allFinite()) low = low.cwiseMin(p), high = high.cwiseMax(p);
  if (!(low.x() <= high.x())) return;
  const double margin = 0.05 * std::max((high - low).maxCoeff(), 1.0);
  if (!panel.x.range) panel.x.range = {low.x() - margin, high.x() + margin};
  if (!panel.y.range) panel.y.range = {low.y() - margin, high.y() + margin};
}

Color method_color(const std::vector<NamedResult>& results, std::size_t i) {
  return method_style(results.size() > kColoredMethods ? 0 : i).color;
}

void add_method_legend(const std::vector<NamedResult>& results, double width_pt, Scene& scene) {
  if (results.size() > kColoredMethods) {
    scene.legend.push_back({.text = "lines found", .stroke = Stroke{method_color(results, 0), width_pt, Dash::solid}});
    return;
  }
  for (std::size_t i = 0; i < results.size(); ++i)
    scene.legend.push_back(
        {.text = results[i].pipeline, .stroke = Stroke{method_color(results, i), width_pt, Dash::solid}});
}

Scene small_multiples(std::size_t panels) {
  Scene scene;
  scene.columns = panels <= 3   ? static_cast<int>(std::max<std::size_t>(1, panels))
                  : panels == 4 ? 2
                  : panels <= 9 ? 3
                                : 4;
  scene.width_in = scene.columns == 1 ? kSingleColumnIn : kDoubleColumnIn;
  scene.share_axes = true;
  scene.scale_bar = true;
  return scene;
}

std::string counted(std::size_t n, const std::string& noun) {
  return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
}

}  // namespace scanbench::render
