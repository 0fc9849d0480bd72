// Writes the trace rows of mean_shift.
#include "algorithms/merge/mean_shift/trace.hpp"

#include <algorithm>
#include <cmath>

#include "core/contracts/mean_shift_trace.hpp"
#include "core/index.hpp"

namespace scanbench::merge {

void trace_joint_space(std::span<const Piece> pieces, const Kernels& kernels, Trace& trace) {
  if (!trace.recording()) return;
  trace.row(mean_shift::Kernel1Row{kernels.sigma_m, kernels.h_rad_per_m});
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const Piece& piece = pieces[k];
    const Vec2 c = piece.segment.midpoint();
    trace.row(mean_shift::JointSpaceRow{static_cast<int>(k), static_cast<int>(piece.line), c.x(), c.y(), piece.alpha,
                                        piece.segment.length()});
  }
}

template <int kPhase>
void trace_trajectories(const Clustering& clustering, Trace& trace) {
  if (!trace.recording()) return;
  for (std::size_t k = 0; k < clustering.paths.size(); ++k) {
    int step = 0;
    for (const auto& p : clustering.paths[k])
      trace.row(mean_shift::TrajectoryRow<kPhase>{static_cast<int>(k), step++, p.x(), p.y(), p.z()});
  }
}
template void trace_trajectories<1>(const Clustering&, Trace&);
template void trace_trajectories<2>(const Clustering&, Trace&);

void trace_ends(const Clustering& first, Trace& trace) {
  if (!trace.recording()) return;
  for (std::size_t k = 0; k < first.end.size(); ++k)
    trace.row(mean_shift::Mode1Row{static_cast<int>(k), first.end[k].x(), first.end[k].y(), first.end[k].z()});
}

void trace_collinear_cluster(int cluster, const Vec2& mode, double theta_rad, std::span<const int> members,
                             std::span<const Piece> pieces, const Kernels& kernels, Trace& trace) {
  if (!trace.recording()) return;
  const Vec2 axis = kernel2_axis(kernels.form, theta_rad);
  const double width = std::sqrt(kernels.factor);
  trace.row(mean_shift::Mode2Row{cluster, mode.x(), mode.y(), theta_rad});
  trace.row(mean_shift::Kernel2Row{cluster, mode.x(), mode.y(), std::atan2(axis.y(), axis.x()),
                                   width * kernels.sigma_x_m, width * kernels.sigma_y_m});
  const Vec2 along(std::cos(theta_rad), std::sin(theta_rad));
  for (const int k : members) {
    const Segment& s = pieces[as_index(k)].segment;
    const auto [u0, u1] = std::minmax({along.dot(s.a - mode), along.dot(s.b - mode)});
    const Vec2 start = mode + u0 * along;
    const Vec2 end = mode + u1 * along;
    trace.row(mean_shift::ProjectionRow{cluster, k, start.x(), start.y(), end.x(), end.y()});
  }
}

void trace_merged(std::span<const DraftLine> drafts, Trace& trace) {
  if (!trace.recording()) return;
  for (const DraftLine& draft : drafts)
    trace.row(mean_shift::MergedRow{draft.cluster, draft.segment.a.x(), draft.segment.a.y(), draft.segment.b.x(),
                                    draft.segment.b.y()});
}

}  // namespace scanbench::merge
