// Labelling of modes: connected components of near points (Lakaemper 2009, section IV.B, with the relation
// d(t_i - t_j) < epsilon made transitive).
#pragma once

#include <span>
#include <vector>

#include "algorithms/merge/parts/point_grid.hpp"

namespace scanbench::merge {

/// Labels of the connected components of points at most epsilon * (1 + 1e-4) apart. The slack is for the pieces of one
/// segment, which are exactly epsilon apart. The third coordinate is periodic if period > 0.
std::vector<int> components_within(std::span<const Vec3> points, double epsilon, double period = 0.0);

/// Conditions under which two modes of a sum of exp(-|d|^2 / 2) are linked. Modes farther apart than epsilon are linked
/// if the density hardly falls on the straight path between them: the density of a wall that was seen often is a ridge
/// with ripples, and the exact modes are on the ripples, two to three standard deviations apart.
struct LinkRules {
  double epsilon;
  double period = 0.0;
  double dip = 0.0;  ///< largest fall of density on the path, as a share of the lower mode's; 0: link by epsilon only
  Vec3 farthest = Vec3::Zero();  ///< largest difference of each coordinate between linked modes of a ridge
};

/// Labels of the connected components of linked modes; `points` make the density.
std::vector<int> linked_modes(std::span<const Vec3> modes, std::span<const Vec3> points, const LinkRules& rules);

}  // namespace scanbench::merge
