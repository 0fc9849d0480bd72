// Writes the trace rows of mean_shift (core/contracts/mean_shift_trace.hpp). The calls do nothing unless the trace is
// recorded.
#pragma once

#include <span>
#include <vector>

#include "algorithms/merge/mean_shift/map_cleanup.hpp"
#include "algorithms/merge/mean_shift/phases.hpp"
#include "algorithms/merge/parts/joint_space.hpp"
#include "core/trace/trace.hpp"

namespace scanbench::merge {

/// kernel1 and joint_space.
void trace_joint_space(std::span<const Piece> pieces, const Kernels& kernels, Trace& trace);

/// trajectory1 or trajectory2.
template <int kPhase>
void trace_trajectories(const Clustering& clustering, Trace& trace);

/// mode1: the mode of each piece in phase 1.
void trace_ends(const Clustering& first, Trace& trace);

/// mode2, kernel2, and the projection of each member on the cluster's line.
void trace_collinear_cluster(int cluster, const Vec2& mode, double theta_rad, std::span<const int> members,
                             std::span<const Piece> pieces, const Kernels& kernels, Trace& trace);

/// merged: lines before joining, trimming and erasing.
void trace_merged(std::span<const DraftLine> drafts, Trace& trace);

}  // namespace scanbench::merge
