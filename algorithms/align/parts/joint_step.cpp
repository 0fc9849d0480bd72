// Assembly of the normal equations of all poses from points and lines.
#include "algorithms/align/parts/joint_step.hpp"

#include <algorithm>
#include <cmath>

#include "algorithms/align/parts/joint_equations.hpp"

namespace scanbench::align {
namespace {

/// Calls visit(i, seen, line, distance) for every reading of every scan i and the nearest line of every other scan, and
/// done(i) after the last reading of a scan.
template <class Visit, class Done>
void for_each_pair(std::span<const ScanShape> scans, const PartnerRules& rules, double longest_m,
                   std::span<const Pose2> world_from_sensor, const Visit& visit, const Done& done) {
  LineGrid grid(rules, longest_m);
  for (std::size_t k = 0; k < scans.size(); ++k) grid.add(static_cast<int>(k), world_from_sensor[k], scans[k].lines);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    for (const Reading& reading : scans[i].readings) {
      const Sighting seen = placed(reading, world_from_sensor[i]);
      grid.for_each_nearest(seen, rules, [&](const PlacedLine& line, double distance) {
        if (static_cast<std::size_t>(line.scan) != i) visit(i, seen, line, distance);
      });
    }
    done(i);
  }
}

}  // namespace

double agreement(std::span<const ScanShape> scans, const PartnerRules& rules, double longest_m,
                 std::span<const Pose2> world_from_sensor) {
  double sum = 0.0;
  for_each_pair(
      scans, rules, longest_m, world_from_sensor,
      [&](std::size_t, const Sighting&, const PlacedLine&, double distance) {
        const double u = distance / rules.gate_m;
        sum += std::pow(std::max(1.0 - u * u, 0.0), 3);
      },
      [](std::size_t) {});
  return sum;
}

JointStep joint_step(std::span<const ScanShape> scans, const PartnerRules& rules, double longest_m,
                     std::vector<Pose2>& world_from_sensor) {
  JointStep step;
  JointEquations equations(scans.size());
  double squares = 0.0, weights = 0.0;
  for_each_pair(
      scans, rules, longest_m, world_from_sensor,
      [&](std::size_t i, const Sighting& seen, const PlacedLine& line, double distance) {
        const auto j = static_cast<std::size_t>(line.scan);
        const Vec2 normal = perpendicular(line.direction);
        const double weight = tukey_weight(distance, rules.gate_m);
        equations.add(i, row_of(normal, seen.point, seen.sensor, scans[i].lever_m), j,
                      -row_of(normal, seen.point, world_from_sensor[j].translation(), scans[j].lever_m), distance,
                      weight);
        squares += weight * distance * distance;
        weights += weight;
        ++step.pairs;
      },
      [&](std::size_t i) { equations.finish(i); });
  if (weights > 0) step.rms_m = std::sqrt(squares / weights);

  step.groups = equations.groups(kFewestShared);
  const std::vector<Eigen::Vector3d> motions = equations.solve(step.lowest_rank);
  for (std::size_t k = 1; k < scans.size(); ++k) {
    const Move move = move_by(motions[k], scans[k].lever_m, world_from_sensor[k]);
    step.largest.shift_m = std::max(step.largest.shift_m, move.shift_m);
    step.largest.turn_rad = std::max(step.largest.turn_rad, move.turn_rad);
  }
  return step;
}

}  // namespace scanbench::align
