// Registers a scan on the lines of a map: Gauss-Newton on oriented distances, gates that narrow, and no motion along
// what the pairs do not determine. Siadat et al. 1997, section 7; Lakaemper, Latecki & Wolter 2005, section 2.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/modules.hpp"

namespace scanbench::mapping {

/// A point of the scan and the line of the map that it should be on: normal . (pose * point) = offset.
struct PointOnLine {
  Vec2 point;   ///< sensor frame
  Vec2 normal;  ///< unit, frame of the map
  double offset_m = 0.0;
  double weight = 1.0;  ///< > 0
};

/// The pairs at a pose, none farther apart than the gate [m].
using FindPairs = std::function<std::vector<PointOnLine>(const Pose2& map_from_sensor, double gate_m)>;

struct RegistrationRule {
  double wide_gate_m = 0.5;    ///< of the first iteration; halved at each one
  double narrow_gate_m = 0.1;  ///< the gate does not become narrower
  double least_share = 0.3;    ///< of `total_weight` that must have partners at the end, else no_match
  int max_iterations = 30;
  double search_rad = 0.0;  ///< farthest turn of the prediction that is tried where it fits badly; 0: none
  double good_share = 0.7;  ///< what fits so well needs no search
};

struct Registration {
  Status status = Status::converged;
  Pose2 map_from_sensor;  ///< for no_match the predicted pose
  int rank = 0;           ///< number of motions that the pairs determine, 0 .. 3
  double share = 0.0;     ///< of total_weight that has partners within the narrow gate
  double rms_m = 0.0;     ///< weighted root mean square of their distances
  int iterations = 0;
  bool by_step = false;  ///< the scan does not meet the map and is placed by the scan before it
};

/// `total_weight`: sum of the weights that all points of the scan would have; `lever_m`: typical distance of them from
/// the sensor, which turns radians into metres. Residuals are weighted down by Tukey's biweight at the gate. The result
/// is `degenerate` if the pairs leave a motion open, along which the pose stays as predicted.
Registration register_on_lines(const FindPairs& find_pairs, const Pose2& predicted, double total_weight, double lever_m,
                               const RegistrationRule& rule);

/// The same, but a result that is farther from the prediction than the narrow gate (a radian counts as `lever_m`) must
/// fit clearly better than the one that the narrow gate alone leads to. At a bend, where a scan has few lines, wide
/// gates pair them with other walls, and those pairs may seem to determine every motion. A pose so far away that still
/// moves is as predicted.
Registration register_near(const FindPairs& find_pairs, const Pose2& predicted, double total_weight, double lever_m,
                           const RegistrationRule& rule);

/// Registers a scan from a predicted pose.
using Locate = std::function<Registration(const Pose2& predicted)>;

/// What `locate` finds from the prediction, and if less than good_share of the scan meets the map there, also from
/// predictions turned about the sensor by multiples of 10 degrees up to search_rad to either side: wheels that slip
/// lose headings first. The result is the one of the largest share, of equal ones that of the smallest turn.
Registration with_search(const Locate& locate, const Pose2& predicted, const RegistrationRule& rule);

/// What `locate` finds from `stepped`, the pose by the scan before; with_search() from the prediction if that is
/// absent. A scan that does not meet the map at `stepped` stays there, `converged`: it is in a part that has no map
/// yet.
Registration from_step(const Locate& locate, const std::optional<Pose2>& stepped, const Pose2& predicted,
                       const RegistrationRule& rule);

/// "2 of 3 motions are determined", "31 % of the scan meets the map": what a status other than `converged` means,
/// or by_step.
std::string explained(const Registration& registration, const RegistrationRule& rule);

}  // namespace scanbench::mapping
