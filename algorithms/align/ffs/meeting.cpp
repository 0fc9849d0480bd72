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
constexpr int kSides = 4;

/// Real points, and behind them those of rectangles. Each scan is a node, and behind the scans each side of a
/// rectangle.
struct Nodes {
  std::vector<Vec2> at, along;
  std::vector<int> node;
  int count;
};

Nodes nodes_of(const FieldPoints& real, const VirtualScan& virtual_scan, int scans) {
  Nodes nodes{real.at, real.direction, real.body, scans};
  for (std::size_t k = 0; k < virtual_scan.points.size(); ++k) {
    if (virtual_scan.side[k] < 0) continue;
    nodes.at.push_back(virtual_scan.points[k]);
    nodes.along.push_back(virtual_scan.directions[k]);
    nodes.node.push_back(scans + virtual_scan.side[k]);
    nodes.count = std::max(nodes.count, scans + kSides * (virtual_scan.side[k] / kSides + 1));
  }
  return nodes;
}

/// Calls visit(v, partners) for every real point with partners: their nodes, each once, in increasing order.
template <class Visit>
void for_each_held(const Nodes& nodes, std::size_t real, double reach, const Visit& visit) {
  const CellGrid grid(nodes.at, reach);
  std::vector<int> partners;
  for (std::size_t v = 0; v < real; ++v) {
    partners.clear();
    grid.for_each_near(nodes.at[v], [&](std::size_t u) {
      if (nodes.node[u] == nodes.node[v] || (nodes.at[u] - nodes.at[v]).squaredNorm() > reach * reach) return;
      if (std::fabs(nodes.along[u].dot(nodes.along[v])) >= kCosAligned) partners.push_back(nodes.node[u]);
    });
    if (partners.empty()) continue;
    std::sort(partners.begin(), partners.end());
    partners.erase(std::unique(partners.begin(), partners.end()), partners.end());
    visit(v, partners);
  }
}

/// Rows of the points of one scan that only one side of a rectangle holds.
struct OnSide {
  int points = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();

  void add(const Eigen::Vector3d& row) {
    ++points;
    sum += row;
    squares += row * row.transpose();
  }
  /// Without the offset of the side, which is then unknown: only the direction is held.
  Eigen::Matrix3d direction_alone() const { return squares - sum * sum.transpose() / points; }
};

using Shared = std::map<std::pair<int, int>, int>;  ///< number of held points of a scan, and of which other node

bool meet(const Shared& shared, int a, int b) {
  const auto found = shared.find(std::minmax(a, b));
  return found != shared.end() && found->second >= kFewestShared;
}

bool others_on_side(const Shared& shared, int scans, int scan, int side) {
  for (int other = 0; other < scans; ++other)
    if (other != scan && meet(shared, other, side)) return true;
  return false;
}

}  // namespace

Meeting meeting_of(std::span<const Body> bodies, std::span<const Pose2> poses, const FieldPoints& real,
                   const VirtualScan& virtual_scan, double reach) {
  const int scans = static_cast<int>(bodies.size());
  const Nodes nodes = nodes_of(real, virtual_scan, scans);
  Shared shared;
  std::vector<Eigen::Matrix3d> normal_matrix(bodies.size(), Eigen::Matrix3d::Zero());
  std::map<std::pair<int, int>, OnSide> on_side;  // by scan and side
  for_each_held(nodes, real.size(), reach, [&](std::size_t v, const std::vector<int>& partners) {
    const int scan = real.body[v];
    for (const int partner : partners) ++shared[std::minmax(scan, partner)];
    const auto b = static_cast<std::size_t>(scan);
    const Eigen::Vector3d row = row_of(perpendicular(real.direction[v]), real.at[v], poses[b] * bodies[b].centre,
                                       std::max(bodies[b].radius, 1e-3));
    if (partners.front() < scans)
      normal_matrix[b] += row * row.transpose();
    else
      on_side[{scan, partners.front()}].add(row);
  });
  for (const auto& [place, rows] : on_side) {
    const auto& [scan, side] = place;
    normal_matrix[static_cast<std::size_t>(scan)] +=
        others_on_side(shared, scans, scan, side) ? rows.squares : rows.direction_alone();
  }

  ScanGroups joined(static_cast<std::size_t>(nodes.count));
  for (int side = scans; side < nodes.count; ++side)  // the sides of a rectangle belong together
    joined.join(static_cast<std::size_t>(side), static_cast<std::size_t>(side - (side - scans) % kSides));
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
