// The trace rows of the aligners ffs and virtual_scans, from which figures are drawn.
#pragma once

#include <string_view>
#include <tuple>

#include "core/trace/trace_schema.hpp"

namespace scanbench::force_field {

/// One iteration of the simulation.
struct IterationRow {
  static constexpr std::string_view kName = "iteration";
  int iteration = 0;
  double sigma_m = 0.0;
  double step = 0.0;  ///< dt^2 / 2
  double potential = 0.0;
  double largest_move_m = 0.0;
  int virtual_points = 0;
  static constexpr auto columns() {
    using R = IterationRow;
    return std::tuple{column("iteration", &R::iteration),
                      column("sigma_m", &R::sigma_m),
                      column("step", &R::step),
                      column("potential", &R::potential),
                      column("largest_move_m", &R::largest_move_m),
                      column("virtual_points", &R::virtual_points)};
  }
};

/// The pose of a scan after an iteration, world frame.
struct PoseRow {
  static constexpr std::string_view kName = "pose";
  int iteration = 0;
  int scan = 0;
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;
  static constexpr auto columns() {
    using R = PoseRow;
    return std::tuple{column("iteration", &R::iteration), column("scan", &R::scan), column("x_m", &R::x_m),
                      column("y_m", &R::y_m), column("yaw_rad", &R::yaw_rad)};
  }
};

/// A line or rectangle that was suspected in an iteration; the corners of a line repeat its second end. World frame.
struct HypothesisRow {
  static constexpr std::string_view kName = "hypothesis";
  int iteration = 0;
  int shape = 0;  ///< 0: line, 1: rectangle
  int id = 0;
  int fate = 0;  ///< 0: born, 1: confirmed, 2: changed, 3: dropped
  double certainty = 0.0;
  double x1_m = 0.0;
  double y1_m = 0.0;
  double x2_m = 0.0;
  double y2_m = 0.0;
  double x3_m = 0.0;
  double y3_m = 0.0;
  double x4_m = 0.0;
  double y4_m = 0.0;
  static constexpr auto columns() {
    using R = HypothesisRow;
    return std::tuple{column("iteration", &R::iteration),
                      column("shape", &R::shape),
                      column("id", &R::id),
                      column("fate", &R::fate),
                      column("certainty", &R::certainty),
                      column("x1_m", &R::x1_m),
                      column("y1_m", &R::y1_m),
                      column("x2_m", &R::x2_m),
                      column("y2_m", &R::y2_m),
                      column("x3_m", &R::x3_m),
                      column("y3_m", &R::y3_m),
                      column("x4_m", &R::x4_m),
                      column("y4_m", &R::y4_m)};
  }
};

}  // namespace scanbench::force_field
