// Stretches of the inliers of a line in scan order.
#include "algorithms/extract/parts/consensus.hpp"

#include <cmath>

#include "core/index.hpp"

namespace scanbench::extract {
namespace {}  // namespace

std::vector<int> largest_support(std::span<const Vec2> points, std::span<const double> tolerance,
                                 std::span<const int> group, const Vec2& normal, double offset, double max_gap_m) {
  std::vector<int> inliers;
  std::vector<std::size_t> starts;  // of the stretches, in inliers
  const double gap2 = max_gap_m * max_gap_m;
  const auto apart = [&](int i, int j) { return (points[as_index(i)] - points[as_index(j)]).squaredNorm() > gap2; };
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    const Vec2& p = points[as_index(i)];
    if (group[as_index(i)] >= 0 || std::fabs(normal.x() * p.x() + normal.y() * p.y() - offset) > tolerance[as_index(i)])
      continue;
    if (inliers.empty() || apart(i, inliers.back())) starts.push_back(inliers.size());
    inliers.push_back(i);
  }
  if (starts.empty()) return {};
  starts.push_back(inliers.size());
  const std::size_t stretches = starts.size() - 1;
  // Across the seam of a full turn, the last stretch continues in the first.
  const bool closed = stretches > 1 && !apart(inliers.front(), inliers.back());
  std::size_t best = 0;
  std::size_t best_size = 0;
  for (std::size_t k = 0; k < stretches; ++k) {
    std::size_t size = starts[k + 1] - starts[k];
    if (closed && k == 0) size += starts[stretches] - starts[stretches - 1];
    if (size > best_size) {
      best_size = size;
      best = k;
    }
  }
  const auto stretch = [&](std::size_t k) {
    return std::span<const int>(inliers).subspan(starts[k], starts[k + 1] - starts[k]);
  };
  std::vector<int> support(stretch(best).begin(), stretch(best).end());
  if (closed && best == 0) support.insert(support.end(), stretch(stretches - 1).begin(), stretch(stretches - 1).end());
  return support;
}

std::vector<int> refined_support(std::span<const Vec2> points, std::span<const double> tolerance,
                                 std::span<const int> group, std::vector<int> support, double max_gap_m) {
  for (int round = 0; round < 10; ++round) {
    const LineFit line = fit_line(moments_of(points, support));
    if (line.degenerate) break;
    std::vector<int> next = largest_support(points, tolerance, group, line.normal, line.offset, max_gap_m);
    if (next.size() < support.size() || next == support) break;
    support = std::move(next);
  }
  return support;
}

}  // namespace scanbench::extract
