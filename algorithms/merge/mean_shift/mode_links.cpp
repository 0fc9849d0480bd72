// Connected components of modes by distance and along ridges.
#include "algorithms/merge/mean_shift/mode_links.hpp"

#include <algorithm>
#include <cmath>

#include "core/disjoint_sets.hpp"

namespace scanbench::merge {

namespace {

constexpr double kDensityCutoff = 4.5;
constexpr double kSampleStep = 0.5;

void unite_within(std::span<const Vec3> points, double epsilon, double period, DisjointSets& sets) {
  if (points.size() < 2) return;
  const double reach = epsilon * (1.0 + 1e-4);
  const PointGrid grid(points, reach, period);
  for (std::size_t i = 0; i < points.size(); ++i) {
    grid.for_each_near(points[i], Vec3::Zero(), reach, [&](std::size_t j, const Vec3&) {
      if (j < i) sets.unite(i, j);
    });
  }
}

double density_at(const PointGrid& grid, Vec3 t) {
  t.z() = reduced(t.z(), grid.period());
  double sum = 0.0;
  grid.for_each_near(t, Vec3::Zero(), kDensityCutoff,
                     [&](std::size_t, const Vec3& d) { sum += std::exp(-0.5 * d.squaredNorm()); });
  return sum;
}

}  // namespace

std::vector<int> components_within(std::span<const Vec3> points, double epsilon, double period) {
  DisjointSets sets(points.size());
  unite_within(points, epsilon, period, sets);
  return sets.labels();
}

std::vector<int> linked_modes(std::span<const Vec3> modes, std::span<const Vec3> points, const LinkRules& rules) {
  DisjointSets sets(modes.size());
  unite_within(modes, rules.epsilon, rules.period, sets);
  if (rules.dip > 0 && modes.size() > 1) {
    const PointGrid of_points(points, 1.0, rules.period);
    const double reach = rules.farthest.norm();
    const PointGrid of_modes(modes, std::max(reach, rules.epsilon), rules.period);
    std::vector<double> density;
    density.reserve(modes.size());
    for (const Vec3& mode : modes) density.push_back(density_at(of_points, mode));
    for (std::size_t i = 0; i < modes.size(); ++i) {
      of_modes.for_each_near(modes[i], Vec3::Zero(), reach, [&](std::size_t j, const Vec3& d) {
        if (j >= i || (d.cwiseAbs().array() > rules.farthest.array()).any() || sets.find(i) == sets.find(j)) return;
        const double least = (1.0 - rules.dip) * std::min(density[i], density[j]);
        const int samples = static_cast<int>(std::ceil(d.norm() / kSampleStep));
        for (int k = 1; k < samples; ++k)
          if (density_at(of_points, modes[i] + (static_cast<double>(k) / samples) * d) < least) return;
        sets.unite(i, j);
      });
    }
  }
  return sets.labels();
}

}  // namespace scanbench::merge
