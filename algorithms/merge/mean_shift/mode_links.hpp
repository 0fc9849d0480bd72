// Labelling: connected components of points that lie near each other (Lakaemper 2009, section IV.B, the relation
// d(t_i - t_j) < epsilon made transitive).
#pragma once

#include <span>
#include <vector>

#include "algorithms/merge/parts/point_grid.hpp"

namespace scanbench::merge {

/// Labels of the connected components of "at most epsilon (times 1 + 1e-4) apart". The slack is for pieces of one
/// segment, which lie exactly epsilon apart. The third coordinate is periodic if period > 0.
std::vector<int> components_within(std::span<const Vec3> points, double epsilon, double period = 0.0);

/// When two modes of exp(-|d|^2 / 2) sums count as one, beyond epsilon: when the density hardly falls on the straight
/// way from one to the other. The density of a wall seen often is a ridge with ripples; exact modes sit on the ripples,
/// two to three standard deviations apart.
struct LinkRules {
  double epsilon;
  double period = 0.0;
  double dip = 0.0;  ///< share of the lower mode's density that may be lost on the way; 0: link by epsilon only
  Vec3 farthest = Vec3::Zero();  ///< largest difference of each coordinate over which ridges link
};

/// Labels of the connected components of modes under these rules; `points` are what the density is made of.
std::vector<int> linked_modes(std::span<const Vec3> modes, std::span<const Vec3> points, const LinkRules& rules);

}  // namespace scanbench::merge
