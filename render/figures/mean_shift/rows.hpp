// The trace of the module mean_shift (docs/algorithms/mean_shift.md, "Trace rows"), for the figures of R. Lakaemper,
// "Simultaneous Multi-Line-Segment Merging for Robot Mapping using Mean Shift Clustering", IROS 2009.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/contracts/mean_shift_trace.hpp"
#include "render/charts/view3.hpp"
#include "render/figure.hpp"
#include "render/figures/parts/clusters.hpp"

namespace scanbench::render {

/// A part of a given segment and its clusters (-1: none).
struct MergePiece {
  Segment segment;            ///< either end first
  Vec3 point = Vec3::Zero();  ///< x, y [m] of the centre, direction [rad]
  int cluster1 = -1;
  int cluster2 = -1;
};

/// A cluster of phase 2.
struct CollinearCluster {
  std::optional<Vec2> mode;
  double theta_rad = 0.0;
  std::optional<Ellipse> kernel;  ///< one standard deviation
  struct Projection {
    std::size_t piece = 0;
    Segment on_line;
  };
  std::vector<Projection> projections;
  std::vector<Segment> merged;
};

struct MeanShiftRows {
  std::string pipeline{};
  std::size_t lines = 0;  ///< given, before long ones are cut into pieces
  double sigma_m = 0.0;
  double h_rad_per_m = 0.0;
  std::vector<MergePiece> pieces{};
  std::vector<std::vector<Vec3>> paths{};  ///< per piece: phase 1 from its point to its mode
  std::vector<Vec3> ends{};                ///< per piece: its mode of phase 1
  std::vector<CollinearCluster> collinear{};
  std::vector<Segment> map{};

  std::vector<Segment> segments() const;
  std::string counted_pieces() const;         ///< "300 segments", "900 pieces of 300 segments"
  ClusteredSegments by_direction() const;     ///< phase 1
  ClusteredSegments by_collinearity() const;  ///< phase 2
};

inline constexpr std::string_view kMergeSlot = "merge";

/// For Figure::trace_rows(): the keys of these rows, and of the row by which mean_shift is recognised.
template <TraceRowType... Rows>
std::vector<std::string> keys_of_mean_shift() {
  return {key_of<mean_shift::CountsRow>(kMergeSlot), key_of<Rows>(kMergeSlot)...};
}

/// The rows of the pipeline with this name or, if it is empty, of the first one that has such rows; nullopt if none
/// has. Parts whose rows were not kept are empty.
std::optional<MeanShiftRows> find_mean_shift(const FigureInput& input, const std::string& pipeline);

/// x, y and direction, around the pieces: the direction from 0 to 180 deg, which is 0 again.
View3 joint_space_view(const MeanShiftRows& rows);
/// A point of the joint space on the axes of that view: its direction in degrees.
Vec3 on_axes(const Vec3& point);

/// The doc of the parameter that every such figure has.
inline constexpr std::string_view kPipelineDoc =
    "pipeline to show; empty: the first one that merges with mean_shift (a pipeline that did not finish is not drawn)";

}  // namespace scanbench::render
