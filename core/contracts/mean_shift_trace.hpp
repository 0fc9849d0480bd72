// The trace rows of the merger mean_shift, from which figures are drawn (docs/algorithms/mean_shift.md, "Trace rows").
// Pieces, clusters and map lines are numbered from 0; -1: none. Directions of segments are in [0, pi).
#pragma once

#include <string_view>
#include <tuple>

#include "core/trace/trace_schema.hpp"

namespace scanbench::mean_shift {

/// Counts of lines, pieces and clusters; the only row of an input without a usable line.
struct CountsRow {
  static constexpr std::string_view kName = "counts";
  int lines = 0;  ///< given
  int pieces = 0;
  int clusters1 = 0;
  int clusters2 = 0;
  int merged = 0;  ///< lines before joining, trimming and erasing
  int map_lines = 0;
  static constexpr auto columns() {
    using R = CountsRow;
    return std::tuple{column("lines", &R::lines),         column("pieces", &R::pieces),
                      column("clusters1", &R::clusters1), column("clusters2", &R::clusters2),
                      column("merged", &R::merged),       column("map_lines", &R::map_lines)};
  }
};

/// The kernel of phase 1.
struct Kernel1Row {
  static constexpr std::string_view kName = "kernel1";
  double sigma_m = 0.0;
  double h_rad_per_m = 0.0;
  static constexpr auto columns() {
    return std::tuple{column("sigma_m", &Kernel1Row::sigma_m), column("h_rad_per_m", &Kernel1Row::h_rad_per_m)};
  }
};

/// A piece as a point of the joint space of centre and direction.
struct JointSpaceRow {
  static constexpr std::string_view kName = "joint_space";
  int piece = 0;
  int line = 0;  ///< the given line that it was cut from
  double x_m = 0.0;
  double y_m = 0.0;
  double alpha_rad = 0.0;
  double length_m = 0.0;
  static constexpr auto columns() {
    using R = JointSpaceRow;
    return std::tuple{column("piece", &R::piece), column("line", &R::line),           column("x_m", &R::x_m),
                      column("y_m", &R::y_m),     column("alpha_rad", &R::alpha_rad), column("length_m", &R::length_m)};
  }
};

/// One step of a piece's climb from its point to its mode.
template <int kPhase>
struct TrajectoryRow {
  static_assert(kPhase == 1 || kPhase == 2);
  static constexpr std::string_view kName = kPhase == 1 ? "trajectory1" : "trajectory2";
  int piece = 0;
  int step = 0;
  double x_m = 0.0;
  double y_m = 0.0;
  double alpha_rad = 0.0;
  static constexpr auto columns() {
    using R = TrajectoryRow;
    return std::tuple{column("piece", &R::piece), column("step", &R::step), column("x_m", &R::x_m),
                      column("y_m", &R::y_m), column("alpha_rad", &R::alpha_rad)};
  }
};

/// The mode to which a piece climbed in phase 1.
struct Mode1Row {
  static constexpr std::string_view kName = "mode1";
  int piece = 0;
  double x_m = 0.0;
  double y_m = 0.0;
  double alpha_rad = 0.0;
  static constexpr auto columns() {
    using R = Mode1Row;
    return std::tuple{column("piece", &R::piece), column("x_m", &R::x_m), column("y_m", &R::y_m),
                      column("alpha_rad", &R::alpha_rad)};
  }
};

/// The mode of a cluster of phase 2.
struct Mode2Row {
  static constexpr std::string_view kName = "mode2";
  int cluster = 0;
  double x_m = 0.0;
  double y_m = 0.0;
  double theta_rad = 0.0;  ///< direction of the cluster's line
  static constexpr auto columns() {
    using R = Mode2Row;
    return std::tuple{column("cluster", &R::cluster), column("x_m", &R::x_m), column("y_m", &R::y_m),
                      column("theta_rad", &R::theta_rad)};
  }
};

/// The kernel of phase 2 at a cluster's mode: an ellipse of one standard deviation.
struct Kernel2Row {
  static constexpr std::string_view kName = "kernel2";
  int cluster = 0;
  double x_m = 0.0;
  double y_m = 0.0;
  double axis_rad = 0.0;  ///< direction of the first axis
  double sigma_x_m = 0.0;
  double sigma_y_m = 0.0;
  static constexpr auto columns() {
    using R = Kernel2Row;
    return std::tuple{column("cluster", &R::cluster),
                      column("x_m", &R::x_m),
                      column("y_m", &R::y_m),
                      column("axis_rad", &R::axis_rad),
                      column("sigma_x_m", &R::sigma_x_m),
                      column("sigma_y_m", &R::sigma_y_m)};
  }
};

/// A piece projected on the line of its cluster of phase 2.
struct ProjectionRow {
  static constexpr std::string_view kName = "projection";
  int cluster = 0;
  int piece = 0;
  double x1_m = 0.0;
  double y1_m = 0.0;
  double x2_m = 0.0;
  double y2_m = 0.0;
  static constexpr auto columns() {
    using R = ProjectionRow;
    return std::tuple{column("cluster", &R::cluster), column("piece", &R::piece), column("x1_m", &R::x1_m),
                      column("y1_m", &R::y1_m),       column("x2_m", &R::x2_m),   column("y2_m", &R::y2_m)};
  }
};

/// A line merged from a cluster of phase 2, before joining, trimming and erasing.
struct MergedRow {
  static constexpr std::string_view kName = "merged";
  int cluster = 0;
  double x1_m = 0.0;
  double y1_m = 0.0;
  double x2_m = 0.0;
  double y2_m = 0.0;
  static constexpr auto columns() {
    using R = MergedRow;
    return std::tuple{column("cluster", &R::cluster), column("x1_m", &R::x1_m), column("y1_m", &R::y1_m),
                      column("x2_m", &R::x2_m), column("y2_m", &R::y2_m)};
  }
};

/// The clusters and the map line of a piece.
struct ClusterRow {
  static constexpr std::string_view kName = "cluster";
  int piece = 0;
  int cluster1 = 0;
  int cluster2 = 0;
  int map_line = 0;
  static constexpr auto columns() {
    using R = ClusterRow;
    return std::tuple{column("piece", &R::piece), column("cluster1", &R::cluster1), column("cluster2", &R::cluster2),
                      column("map_line", &R::map_line)};
  }
};

/// A line of the map.
struct IntervalRow {
  static constexpr std::string_view kName = "interval";
  double x1_m = 0.0;
  double y1_m = 0.0;
  double x2_m = 0.0;
  double y2_m = 0.0;
  static constexpr auto columns() {
    using R = IntervalRow;
    return std::tuple{column("x1_m", &R::x1_m), column("y1_m", &R::y1_m), column("x2_m", &R::x2_m),
                      column("y2_m", &R::y2_m)};
  }
};

}  // namespace scanbench::mean_shift
