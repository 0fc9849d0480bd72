// Force field simulation. Scans are rigid bodies that move in the field of the other scans until none moves (Lakaemper
// 2010, section 3; section 5 for the version with a virtual scan).
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "algorithms/align/ffs/body.hpp"
#include "algorithms/align/ffs/force_field.hpp"
#include "algorithms/align/ffs/schedule.hpp"
#include "algorithms/align/ffs/virtual_scan.hpp"
#include "core/modules.hpp"

namespace scanbench::align::ffs {

/// The current map, from which hypotheses are made: real data only, in the frame of the simulation.
struct CurrentMap {
  int iteration;
  const FieldPoints& points;
  std::span<const Segment> lines;
  std::span<const int> body_of_line;
  const Pose2& world_from_map;  ///< for the trace
};
using Hypothesize = std::function<VirtualScan(const CurrentMap&, Trace&)>;

/// Aligns the scans. `hypothesize` may be empty; it is called before every iteration except the first, in which the
/// virtual scan is empty. Only relative poses are determined, so the first scan keeps its given pose.
///
/// Trace rows: `iteration` (iteration, sigma [m], dt^2 / 2, potential, largest displacement [m], virtual points), and
/// `pose` (iteration, scan, x, y, yaw) before each iteration and after the last.
///
/// The status is converged if the cooling has ended and no point moved by more than a thousandth of sigma_end_m in two
/// consecutive iterations; degenerate if scans or groups of scans do not meet, or a scan can slide along those that it
/// meets; no_match if no two scans meet (the poses are then those given); otherwise max_iterations. The message names
/// the scans.
Alignment simulate(std::span<const Observation> scans, std::span<const Pose2> initial, const Schedule& schedule,
                   const Hypothesize& hypothesize, Trace& trace);

}  // namespace scanbench::align::ffs
