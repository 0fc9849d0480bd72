// Force field simulation: scans as rigid bodies that move in each other's field until nothing moves any more
// (Lakaemper 2010, section 3; with a virtual scan among them, section 5).
#pragma once

#include <functional>
#include <span>
#include <tuple>
#include <vector>

#include "algorithms/align/ffs/body.hpp"
#include "algorithms/align/ffs/force_field.hpp"
#include "core/modules.hpp"
#include "core/params.hpp"

namespace scanbench::align::ffs {

/// Names, defaults and documentation of the parameters that all simulations share.
struct Schedule {
  double resample_m = 0.1;
  double sigma_start_m = 0.6;
  double sigma_end_m = 0.05;
  int cooling_iterations = 60;
  int max_iterations = 200;
  double step_start = 10.0;
  double step_end = 1.0;
  double cut_sigmas = 4.0;
  double soft_sigmas = 0.05;

  double sigma_at(int iteration) const;  ///< geometric from start to end, then constant
  double step_at(int iteration) const;   ///< the same
  bool cooled(int iteration) const { return iteration + 1 >= cooling_iterations; }
  /// Throws ParamError for an end above its start, or fewer iterations than it takes to cool.
  void check() const;
};

template <class P>
auto schedule_fields() {
  return std::tuple{
      field("resample_m", &P::resample_m, between(1e-4, 1e3), "m", "distance of the points along the lines of a scan"),
      field("sigma_start_m", &P::sigma_start_m, between(1e-6, 1e6), "m",
            "radius of the field in the first iteration: about twice the expected error of a point"),
      field("sigma_end_m", &P::sigma_end_m, between(1e-6, 1e6), "m", "radius of the field once it has cooled"),
      field("cooling_iterations", &P::cooling_iterations, between(1, 1e6), "",
            "iterations in which radius and step width fall geometrically from start to end"),
      field("max_iterations", &P::max_iterations, between(1, 1e6), "", "iterations at most"),
      field("step_start", &P::step_start, between(1e-6, 1e3), "",
            "step width in the first iteration: share of the largest step that no scan overshoots with"),
      field("step_end", &P::step_end, between(1e-6, 1e3), "", "step width once it has cooled"),
      field("cut_sigmas", &P::cut_sigmas, between(2, 10), "",
            "pairs farther apart than this many radii exert no force: exp(-cut^2/2) of the largest is left out"),
      field("soft_sigmas", &P::soft_sigmas, between(1e-6, 1), "",
            "pairs nearer than this many radii pull in proportion to their distance, not with full force")};
}

/// The members of Params that schedule_fields() names.
template <class P>
Schedule schedule_of(const P& p) {
  const Schedule schedule{p.resample_m, p.sigma_start_m, p.sigma_end_m, p.cooling_iterations, p.max_iterations,
                          p.step_start, p.step_end,      p.cut_sigmas,  p.soft_sigmas};
  schedule.check();
  return schedule;
}

/// A virtual scan (section 4.3): points that attract and do not move.
struct VirtualScan {
  std::vector<Vec2> points;
  std::vector<Vec2> directions;
  std::vector<double> weights;
  std::vector<int> holds;  ///< number of the hypothesis, if two scans on it hold each other; -1: they can slide
};

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
