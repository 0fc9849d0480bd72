// Forces and potential of force field simulation by the plain double loop: equations 1 and 2 of Lakaemper 2010, without
// index, cut or single precision; with `soft` = 0 as they stand, else proportional to d nearer than that.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "algorithms/align/ffs/force_field.hpp"

namespace scanbench::support {

/// On point v.
inline Vec2 plain_force_on(std::size_t v, const align::ffs::FieldPoints& points, double sigma, double soft = 0.0) {
  Vec2 force = Vec2::Zero();
  for (std::size_t u = 0; u < points.size(); ++u) {
    const Vec2 to = points.at[u] - points.at[v];
    const double d = to.norm();
    if (points.body[u] == points.body[v] || d == 0) continue;
    const double cosine = std::abs(points.direction[u].dot(points.direction[v]));
    const double m = std::exp(-d * d / (2 * sigma * sigma)) / (sigma * std::sqrt(kTwoPi)) * points.weight[u] *
                     points.weight[v] * cosine;
    force += m * to / std::max(d, soft);
  }
  return force;
}

inline std::vector<Vec2> plain_forces(const align::ffs::FieldPoints& points, double sigma, double soft = 0.0) {
  std::vector<Vec2> forces;
  for (std::size_t v = 0; v < points.size(); ++v) forces.push_back(plain_force_on(v, points, sigma, soft));
  return forces;
}

inline double plain_potential(const align::ffs::FieldPoints& points, double sigma) {
  double sum = 0.0;
  for (std::size_t v = 0; v < points.size(); ++v)
    for (std::size_t u = v + 1; u < points.size(); ++u) {
      if (points.body[u] == points.body[v]) continue;
      const double d = (points.at[u] - points.at[v]).norm();
      const double cosine = std::abs(points.direction[u].dot(points.direction[v]));
      sum -= 0.5 * points.weight[u] * points.weight[v] * cosine * std::erfc(d / (sigma * std::sqrt(2.0)));
    }
  return sum;
}

}  // namespace scanbench::support
