// The cooling schedule of a simulation: the width of the field and the size of the steps in each iteration.
#pragma once

#include <tuple>

#include "core/params.hpp"

namespace scanbench::align::ffs {

/// The fields of Schedule for parameters P that have its members and more.
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
  /// Throws ParamError for an end above its start, and for fewer iterations than the cooling takes.
  void check() const;
  static auto fields() { return schedule_fields<Schedule>(); }
};

/// The members of Params that schedule_fields() names.
template <class P>
Schedule schedule_of(const P& p) {
  const Schedule schedule{p.resample_m, p.sigma_start_m, p.sigma_end_m, p.cooling_iterations, p.max_iterations,
                          p.step_start, p.step_end,      p.cut_sigmas,  p.soft_sigmas};
  schedule.check();
  return schedule;
}

}  // namespace scanbench::align::ffs
