// Force field simulation: scans as rigid bodies that move in each other's field until nothing moves any more
// (Lakaemper 2010, section 3; with a virtual scan among them, section 5).
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

/// The current map as hypotheses are made from it: real data only. Frame: that of the simulation.
struct CurrentMap {
  int iteration;
  const FieldPoints& points;
  std::span<const Segment> lines;
  std::span<const int> body_of_line;
  const Pose2& world_from_map;  ///< for the trace
};
using Hypothesize = std::function<VirtualScan(const CurrentMap&, Trace&)>;

/// Aligns the scans; `hypothesize` is called before every iteration but the first (the virtual scan is empty then), and
/// may be empty. Only relative poses are determined: the first scan keeps its given pose.
///
/// Trace rows: `iteration` (iteration, sigma [m], dt^2 / 2, potential, largest displacement [m], virtual points), and
/// `pose` (iteration, scan, x, y, yaw) before each iteration and after the last.
///
/// converged: cooled down, and no point moved by more than a thousandth of sigma_end_m twice running. degenerate: scans
/// or groups of scans that do not meet, or a scan that can slide along what it meets. no_match: no two scans meet; the
/// poses come back as they were. max_iterations otherwise. The message names the scans.
Alignment simulate(std::span<const Observation> scans, std::span<const Pose2> initial, const Schedule& schedule,
                   const Hypothesize& hypothesize, Trace& trace);

}  // namespace scanbench::align::ffs
