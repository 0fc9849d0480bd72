// Finds the partners of all points among the points of other scans and of hypotheses.
#include "algorithms/align/ffs/meeting.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "algorithms/align/parts/cell_grid.hpp"
#include "algorithms/align/parts/pose_equations.hpp"

namespace scanbench::align::ffs {
namespace {

constexpr int kFewestShared = 5;
constexpr double kCosAligned = 0.8660254037844386;  // 30 degrees

}  // namespace

Meeting meeting_of(std::span<const Body> bodies, std::span<const Pose2> poses, const FieldPoints& real,
                   const VirtualScan& virtual_scan, double reach) {
  // After the scans, each hypothesis that holds is a node of its own. Two scans on two different hypotheses do not hold
  // each other.
  const int scans = static_cast<int>(bodies.size());
  int nodes = scans;
  std::vector<Vec2> at = real.at, along = real.direction;
  std::vector<int> node = real.body;
  for (std::size_t k = 0; k < virtual_scan.points.size(); ++k) {
    if (virtual_scan.holds[k] < 0) continue;
    at.push_back(virtual_scan.points[k]);
    along.push_back(virtual_scan.directions[k]);
    node.push_back(scans + virtual_scan.holds[k]);
    nodes = std::max(nodes, node.back() + 1);
  }

  const CellGrid grid(at, reach);
  std::map<std::pair<int, int>, int> shared;
  std::vector<Eigen::Matrix3d> normal_matrix(bodies.size(), Eigen::Matrix3d::Zero());
  std::vector<int> partners;
  for (std::size_t v = 0; v < real.size(); ++v) {
    partners.clear();
    grid.for_each_near(at[v], [&](std::size_t u) {
      if (node[u] == node[v] || (at[u] - at[v]).squaredNorm() > reach * reach) return;
      if (std::fabs(along[u].dot(along[v])) >= kCosAligned) partners.push_back(node[u]);
    });
    if (partners.empty()) continue;
    std::sort(partners.begin(), partners.end());
    partners.erase(std::unique(partners.begin(), partners.end()), partners.end());
    for (const int partner : partners) ++shared[std::minmax(node[v], partner)];
    const auto b = static_cast<std::size_t>(node[v]);
    const Eigen::Vector3d row =
        row_of(perpendicular(along[v]), at[v], poses[b] * bodies[b].centre, std::max(bodies[b].radius, 1e-3));
    normal_matrix[b] += row * row.transpose();
  }

  ScanGroups joined(static_cast<std::size_t>(nodes));
  for (const auto& [pair, count] : shared)
    if (count >= kFewestShared)
      joined.join(static_cast<std::size_t>(pair.first), static_cast<std::size_t>(pair.second));
  Meeting meeting{ScanGroups(bodies.size()), {}};
  for (const auto& group : joined.groups())
    for (const std::size_t member : group)
      if (member < bodies.size()) meeting.groups.join(group.front(), member);  // the scans come before the hypotheses
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (!normal_matrix[b].isZero(0.0) && observable(normal_matrix[b]).rank() < 3) meeting.sliding.push_back(b);
  return meeting;
}

}  // namespace scanbench::align::ffs
