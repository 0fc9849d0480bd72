// Iterates pairs and steps until a step is small.
#include "algorithms/map/parts/registration.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "algorithms/align/parts/pose_equations.hpp"
#include "algorithms/align/parts/register_scan.hpp"
#include "core/geometry/pose_errors.hpp"
#include "core/number_text.hpp"

namespace scanbench::mapping {
namespace {

constexpr double kAsWell = 0.9;                // a fit with so much of the share of another one is as good
constexpr double kSearchStep = radians(10.0);  // less than the angles up to which lines are partners

double residual_of(const PointOnLine& pair, const Pose2& pose) {
  return pair.normal.dot(pose * pair.point) - pair.offset_m;
}

/// The normal equations of one step, in metres (x, y, lever * yaw).
struct Equations {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
};

Equations equations_of(const std::vector<PointOnLine>& pairs, const Pose2& pose, double gate, double lever) {
  Equations equations;
  for (const PointOnLine& pair : pairs) {
    const double residual = residual_of(pair, pose);
    const double weight = pair.weight * align::tukey_weight(residual, gate);
    const Eigen::Vector3d row = align::row_of(pair.normal, pose * pair.point, pose.translation(), lever);
    equations.matrix += weight * row * row.transpose();
    equations.right -= weight * residual * row;
  }
  return equations;
}

/// The motion from one pose to another, in metres (x, y, lever * yaw).
Eigen::Vector3d motion_between(const Pose2& from, const Pose2& to, double lever) {
  const Eigen::Vector3d motion = pose_error(to, from);
  return {motion.x(), motion.y(), lever * motion.z()};
}

/// The pose, but along motions that are not known as predicted.
Pose2 with_open_motions_of(const Pose2& predicted, const Pose2& pose, const align::Observable& known, double lever) {
  Pose2 result = predicted;
  const Eigen::Vector3d motion = motion_between(predicted, pose, lever);
  Eigen::Vector3d known_part = Eigen::Vector3d::Zero();
  for (int k = 0; k < known.rank(); ++k) known_part += known.motions.col(k).dot(motion) * known.motions.col(k);
  align::move_by(known_part, lever, result);
  return result;
}

}  // namespace

Registration register_on_lines(const FindPairs& find_pairs, const Pose2& predicted, double total_weight, double lever_m,
                               const RegistrationRule& rule) {
  const align::Gates gates{.wide_m = rule.wide_gate_m, .narrow_m = rule.narrow_gate_m};
  Registration result{.map_from_sensor = predicted};
  bool settled = false;
  for (; result.iterations < rule.max_iterations && !settled; ++result.iterations) {
    const double gate = gates.at(result.iterations);
    const Equations equations =
        equations_of(find_pairs(result.map_from_sensor, gate), result.map_from_sensor, 2 * gate, lever_m);
    const align::Observable known = align::observable(equations.matrix);
    result.rank = known.rank();
    if (result.rank == 0) break;
    const Eigen::Vector3d motion =
        known.motions * (known.motions.transpose() * equations.right).cwiseQuotient(known.eigenvalues);
    const Pose2 before = result.map_from_sensor;
    bool small = align::move_by(motion, lever_m, result.map_from_sensor).small();
    if (result.rank < 3) {
      // An iteration with a wide gate may have moved the pose along what is open now, by pairs that are none any more.
      result.map_from_sensor = with_open_motions_of(predicted, result.map_from_sensor, known, lever_m);
      Pose2 moved = before;
      small = align::move_by(motion_between(before, result.map_from_sensor, lever_m), lever_m, moved).small();
    }
    settled = small && gates.narrow(result.iterations);
  }
  double weight = 0.0, squares = 0.0;
  for (const PointOnLine& pair : find_pairs(result.map_from_sensor, rule.narrow_gate_m)) {
    const double residual = residual_of(pair, result.map_from_sensor);
    weight += pair.weight;
    squares += pair.weight * residual * residual;
  }
  if (total_weight > 0) result.share = weight / total_weight;
  if (weight > 0) result.rms_m = std::sqrt(squares / weight);
  if (result.rank == 0 || result.share < rule.least_share) {
    result.status = Status::no_match;
    result.map_from_sensor = predicted;
  } else if (result.rank < 3) {
    result.status = Status::degenerate;
  } else if (!settled) {
    result.status = Status::max_iterations;
  }
  return result;
}

Registration register_near(const FindPairs& find_pairs, const Pose2& predicted, double total_weight, double lever_m,
                           const RegistrationRule& rule) {
  const auto correction = [&](const Registration& r) {
    return motion_between(predicted, r.map_from_sensor, lever_m).norm();
  };
  Registration found = register_on_lines(find_pairs, predicted, total_weight, lever_m, rule);
  if (found.status == Status::no_match || correction(found) <= rule.narrow_gate_m) return found;
  RegistrationRule narrow = rule;
  narrow.wide_gate_m = rule.narrow_gate_m;
  const Registration nearer = register_on_lines(find_pairs, predicted, total_weight, lever_m, narrow);
  const bool fits_as_well = nearer.status != Status::no_match && nearer.share >= kAsWell * found.share;
  if (fits_as_well && correction(nearer) < correction(found)) found = nearer;
  if (found.status == Status::max_iterations && correction(found) > rule.narrow_gate_m)
    found.map_from_sensor = predicted;
  return found;
}

Registration with_search(const Locate& locate, const Pose2& predicted, const RegistrationRule& rule) {
  Registration best = locate(predicted);
  const int steps = static_cast<int>(rule.search_rad / kSearchStep + 1e-9);
  for (int k = 1; k <= steps && best.share < rule.good_share; ++k)
    for (const double side : {1.0, -1.0}) {
      const Registration found = locate(predicted * Pose2(0, 0, side * k * kSearchStep));
      if (found.status != Status::no_match && found.share > best.share) best = found;
    }
  if (best.status == Status::no_match) best.map_from_sensor = predicted;
  return best;
}

Registration from_step(const Locate& locate, const std::optional<Pose2>& stepped, const Pose2& predicted,
                       const RegistrationRule& rule) {
  if (!stepped) return with_search(locate, predicted, rule);
  Registration found = locate(*stepped);
  if (found.status != Status::no_match) return found;
  found.status = Status::converged;
  found.map_from_sensor = *stepped;
  found.by_step = true;
  return found;
}

std::string explained(const Registration& registration, const RegistrationRule& rule) {
  if (registration.by_step)
    return number_text(std::round(100 * registration.share)) +
           " % of the scan meets the map; it is inserted where it meets the scan before";
  switch (registration.status) {
    case Status::converged:
      break;
    case Status::no_match:
      return number_text(std::round(100 * registration.share)) + " % of the scan meets the map; at least " +
             number_text(std::round(100 * rule.least_share)) + " % must";
    case Status::degenerate:
      return "the scan determines " + std::to_string(registration.rank) +
             " of 3 motions; along the others poses are as predicted";
    case Status::max_iterations:
      return "poses still moved after " + std::to_string(registration.iterations) + " iterations";
  }
  return "";
}

}  // namespace scanbench::mapping
