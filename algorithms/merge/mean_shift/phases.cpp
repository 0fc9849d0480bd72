// Modes and labels of phases 1 and 2 (Lakaemper 2009, sections IV.B and IV.C).
#include "algorithms/merge/mean_shift/phases.hpp"

#include <cmath>

#include "algorithms/merge/mean_shift/mode_links.hpp"
#include "algorithms/merge/mean_shift/modes.hpp"
#include "core/index.hpp"

namespace scanbench::merge {
namespace {

// Largest distance of linked modes of a ridge, in standard deviations. Their directions differ by at most a quarter of
// a standard deviation; otherwise a round column would become one cluster without a direction.
constexpr double kRidgeReach = 4.0;
constexpr double kRidgeTurn = 0.25;

/// Sets `result` for the members of one cluster of phase 1: the modes of the density of their centres.
void cluster_one_line(std::span<const Piece> pieces, const std::vector<int>& members, double theta,
                      const Kernels& kernels, bool with_paths, Clustering& result) {
  const Vec2 along = kernel2_axis(kernels.form, theta);
  const Vec2 across = perpendicular(along);
  const double scale_u = std::sqrt(kernels.factor) * kernels.sigma_x_m;
  const double scale_v = std::sqrt(kernels.factor) * kernels.sigma_y_m;
  // Relative to the first member: far from the origin, differences would lose digits compared with the narrow kernel.
  const Vec2 origin = pieces[as_index(members.front())].segment.midpoint();
  std::vector<Vec3> points;
  points.reserve(members.size());
  for (const int k : members) {
    const Vec2 d = pieces[as_index(k)].segment.midpoint() - origin;
    points.emplace_back(along.dot(d) / scale_u, across.dot(d) / scale_v, 0.0);  // eqs 5 and 6 in the rotated frame
  }
  std::vector<std::vector<Vec3>> paths;
  const Modes modes =
      find_modes(points, {.cutoff = kernels.cutoff, .accelerate = kernels.accelerate, .capture = kernels.capture},
                 with_paths ? &paths : nullptr);
  result.converged = result.converged && modes.converged;
  // Modes of a ridge are linked along the line up to the distance at which two isolated pieces could be one mode, and
  // across it up to epsilon.
  const double epsilon = kernels.epsilon2 / std::sqrt(kernels.factor);
  const std::vector<int> label = linked_modes(
      modes.positions, points, {.epsilon = epsilon, .dip = kernels.ridge_dip, .farthest = {kRidgeReach, epsilon, 0.0}});

  const auto in_world = [&](const Vec3& p) {
    const Vec2 q = origin + p.x() * scale_u * along + p.y() * scale_v * across;
    return Vec3(q.x(), q.y(), theta);
  };
  // Sub-clusters are numbered by their first pieces, not in the order in which modes were found.
  std::vector<int> number(modes.positions.size(), -1);
  for (std::size_t m = 0; m < members.size(); ++m) {
    const auto piece = as_index(members[m]);
    const auto mode = as_index(modes.mode_of[m]);
    int& cluster = number[as_index(label[mode])];
    if (cluster < 0) cluster = result.clusters++;
    result.cluster[piece] = cluster;
    result.end[piece] = in_world(modes.positions[mode]);
    if (with_paths)
      for (const Vec3& p : paths[m]) result.paths[piece].push_back(in_world(p));
  }
}

}  // namespace

std::vector<std::vector<int>> members_of(std::span<const int> cluster, int clusters) {
  std::vector<std::size_t> sizes(as_index(clusters), 0);
  for (const int c : cluster)
    if (c >= 0) ++sizes[as_index(c)];
  std::vector<std::vector<int>> members(as_index(clusters));
  for (std::size_t c = 0; c < members.size(); ++c) members[c].reserve(sizes[c]);
  for (std::size_t i = 0; i < cluster.size(); ++i)
    if (cluster[i] >= 0) members[as_index(cluster[i])].push_back(static_cast<int>(i));
  return members;
}

Vec2 kernel2_axis(Kernel2 form, double theta_rad) {
  // The sign of b in eq. 6 is that of a clockwise theta: with y upwards its kernel is long along -theta.
  const double angle = form == Kernel2::printed ? -theta_rad : theta_rad;
  return {std::cos(angle), std::sin(angle)};
}

Clustering cluster_directions(std::span<const Piece> pieces, const Kernels& kernels, bool with_paths) {
  const double sigma = kernels.sigma_m;
  const double angle_scale = kernels.h_rad_per_m * sigma;  // eq. 4: radians per standard deviation
  const double period = kPi / angle_scale;
  std::vector<Vec3> points;
  points.reserve(pieces.size());
  for (const Piece& piece : pieces) {
    const Vec2 centre = piece.segment.midpoint();  // eq. 2
    const double z = piece.alpha / angle_scale;
    points.emplace_back(centre.x() / sigma, centre.y() / sigma, z < period ? z : 0.0);
  }
  Clustering result;
  const Modes modes = find_modes(
      points,
      {.cutoff = kernels.cutoff, .period = period, .accelerate = kernels.accelerate, .capture = kernels.capture},
      with_paths ? &result.paths : nullptr);
  result.converged = modes.converged;
  const std::vector<int> label = linked_modes(modes.positions, points,
                                              {.epsilon = kernels.epsilon1_m / sigma,
                                               .period = period,
                                               .dip = kernels.ridge_dip,
                                               .farthest = {kRidgeReach, kRidgeReach, kRidgeTurn}});

  const auto in_world = [&](const Vec3& p) {
    return Vec3(p.x() * sigma, p.y() * sigma, direction_mod_pi(p.z() * angle_scale));
  };
  std::vector<int> number(modes.positions.size(), -1);
  result.cluster.reserve(pieces.size());
  result.end.reserve(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto mode = as_index(modes.mode_of[i]);
    int& cluster = number[as_index(label[mode])];
    if (cluster < 0) cluster = result.clusters++;
    result.cluster.push_back(cluster);
    result.end.push_back(in_world(modes.positions[mode]));
  }
  for (auto& path : result.paths)
    for (Vec3& p : path) p = in_world(p);
  return result;
}

Clustering cluster_collinear(std::span<const Piece> pieces, std::span<const int> cluster1,
                             std::span<const double> directions, const Kernels& kernels, bool with_paths) {
  Clustering result;
  result.cluster.assign(pieces.size(), -1);
  result.end.assign(pieces.size(), Vec3::Zero());
  if (with_paths) result.paths.resize(pieces.size());
  const auto members = members_of(cluster1, static_cast<int>(directions.size()));
  for (std::size_t c = 0; c < members.size(); ++c)
    cluster_one_line(pieces, members[c], directions[c], kernels, with_paths, result);
  return result;
}

}  // namespace scanbench::merge
