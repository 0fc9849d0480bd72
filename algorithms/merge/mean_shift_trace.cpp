#include "algorithms/merge/mean_shift_trace.hpp"

#include <algorithm>
#include <cmath>

namespace scanbench::merge {

void trace_joint_space(std::span<const Piece> pieces, const Kernels& kernels, Trace& trace) {
  if (!trace.recording()) return;
  trace.row("kernel1", {kernels.sigma_m, kernels.h_rad_per_m});
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const Piece& piece = pieces[k];
    const Vec2 c = piece.segment.midpoint();
    trace.row("joint_space", {static_cast<double>(k), static_cast<double>(piece.line), c.x(), c.y(), piece.alpha,
                              piece.segment.length()});
  }
}

void trace_trajectories(const Clustering& clustering, std::string_view name, Trace& trace) {
  if (!trace.recording()) return;
  for (std::size_t k = 0; k < clustering.paths.size(); ++k) {
    double step = 0.0;
    for (const auto& p : clustering.paths[k]) trace.row(name, {static_cast<double>(k), step++, p.x(), p.y(), p.z()});
  }
}

void trace_ends(const Clustering& first, Trace& trace) {
  if (!trace.recording()) return;
  for (std::size_t k = 0; k < first.end.size(); ++k)
    trace.row("mode1", {static_cast<double>(k), first.end[k].x(), first.end[k].y(), first.end[k].z()});
}

void trace_collinear_cluster(int cluster, const Vec2& mode, double theta_rad, std::span<const int> members,
                             std::span<const Piece> pieces, const Kernels& kernels, Trace& trace) {
  if (!trace.recording()) return;
  const auto c = static_cast<double>(cluster);
  const Vec2 axis = kernel2_axis(kernels.form, theta_rad);
  const double width = std::sqrt(kernels.factor);
  trace.row("mode2", {c, mode.x(), mode.y(), theta_rad});
  trace.row("kernel2", {c, mode.x(), mode.y(), std::atan2(axis.y(), axis.x()), width * kernels.sigma_x_m,
                        width * kernels.sigma_y_m});
  const Vec2 along(std::cos(theta_rad), std::sin(theta_rad));
  for (const int k : members) {
    const Segment& s = pieces[static_cast<std::size_t>(k)].segment;
    const auto [u0, u1] = std::minmax({along.dot(s.a - mode), along.dot(s.b - mode)});
    const Vec2 start = mode + u0 * along;
    const Vec2 end = mode + u1 * along;
    trace.row("projection", {c, static_cast<double>(k), start.x(), start.y(), end.x(), end.y()});
  }
}

void trace_merged(std::span<const DraftLine> drafts, Trace& trace) {
  if (!trace.recording()) return;
  for (const DraftLine& draft : drafts)
    trace.row("merged", {static_cast<double>(draft.cluster), draft.segment.a.x(), draft.segment.a.y(),
                         draft.segment.b.x(), draft.segment.b.y()});
}

}  // namespace scanbench::merge
