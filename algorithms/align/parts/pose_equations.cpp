// Registered parts of a scan, the rank rule and the update of a pose.
#include "algorithms/align/parts/pose_equations.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/symmetric_matrix.hpp"

namespace scanbench::align {
namespace {

constexpr double kUnobservable = 1e-3;  // share of the largest eigenvalue
constexpr double kFarthestM = 1e9;
constexpr double kShortestLeverM = 1e-3;

bool near(const Vec2& p) {
  return p.allFinite() && p.cwiseAbs().maxCoeff() <= kFarthestM;
}

}  // namespace

ScanShape shape_of(const Observation& observation) {
  ScanShape shape;
  for (const LineFeature& line : observation.lines.lines)
    if (near(line.segment.a) && near(line.segment.b) && line.segment.length() > 0) shape.lines.push_back(line.segment);
  std::vector<double> ranges;
  const ScanPoints valid = valid_points(observation.scan);
  for (std::size_t k = 0; k < valid.size(); ++k) {
    if (!near(valid.points[k])) continue;
    const int label = observation.lines.labels[static_cast<std::size_t>(valid.beams[k])];
    Vec2 surface = Vec2::Zero();
    if (label >= 0) surface = observation.lines.lines[static_cast<std::size_t>(label)].segment.direction();
    shape.readings.push_back({valid.points[k], surface});
    ranges.push_back(valid.points[k].norm());
  }
  if (ranges.empty()) return shape;
  const auto middle = ranges.begin() + static_cast<std::ptrdiff_t>(ranges.size() / 2);
  std::nth_element(ranges.begin(), middle, ranges.end());
  shape.lever_m = std::max(*middle, kShortestLeverM);
  return shape;
}

Observable observable(const Eigen::Matrix3d& normal_matrix) {
  const auto [values, vectors] = symmetric_eigen(normal_matrix);
  Eigen::Index rank = 0;
  while (rank < 3 && values(2 - rank) > 0 && values(2 - rank) >= kUnobservable * values(2)) ++rank;
  return {vectors.rightCols(rank), values.tail(rank)};
}

Move move_by(const Eigen::Vector3d& motion, double lever_m, Pose2& world_from_sensor) {
  const Vec2 shift = motion.head<2>();
  const double turn = motion.z() / lever_m;
  const Pose2 turned = Pose2(0, 0, turn) * Pose2::from_unit({0, 0}, {world_from_sensor.cos(), world_from_sensor.sin()});
  world_from_sensor = Pose2::from_unit(world_from_sensor.translation() + shift, {turned.cos(), turned.sin()});
  return {shift.norm(), std::abs(turn)};
}

}  // namespace scanbench::align
