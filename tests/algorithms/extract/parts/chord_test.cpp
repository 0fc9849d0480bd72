// The point farthest from a chord, against a search that looks at one point at a time.
#include "algorithms/extract/parts/chord.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "algorithms/extract/parts/chord_kernels.hpp"
#include "core/index.hpp"
#include "core/isa.hpp"
#include "core/rng.hpp"

namespace scanbench::extract {
namespace {

// Points on a coarse lattice, so that several are equally far.
std::vector<Vec2> lattice_points(std::uint32_t seed, int n) {
  CounterRng rng(seed, RngStream::pose);
  std::vector<Vec2> points;
  for (int i = 0; i < n; ++i) points.emplace_back(i, std::floor(7 * rng.uniform()) - 3);
  return points;
}

TEST(FarthestFromChord, IsTheFirstOfThoseAtTheGreatestDistance) {
  for (std::uint32_t seed = 0; seed < 50; ++seed)
    for (int n = 3; n <= 24; ++n) {
      const std::vector<Vec2> points = lattice_points(seed, n);
      const Vec2 chord = points.back() - points.front();
      int first = 0;
      double most = -1.0;
      for (int i = 1; i + 1 < n; ++i) {
        const double d = std::fabs(cross(chord, points[as_index(i)] - points.front()));
        if (d <= most) continue;
        most = d;
        first = i;
      }
      const Farthest far = farthest_from_chord(points, {0, n - 1});
      EXPECT_EQ(far.index, first) << "seed " << seed << ", " << n << " points";
      EXPECT_DOUBLE_EQ(far.distance(), most / chord.norm());
    }
}

TEST(FarthestFromChord, HasEqualBytesOnEveryProcessor) {
  if (best_isa() == Isa::baseline) GTEST_SKIP() << "this processor has no AVX2";
  for (std::uint32_t seed = 0; seed < 50; ++seed)
    for (int n = 1; n <= 24; ++n) {
      CounterRng rng(seed, RngStream::range);
      std::vector<double> points;
      for (int i = 0; i < 2 * n; ++i) points.push_back(rng.normal());
      const double a[] = {rng.normal(), rng.normal()}, chord[] = {rng.normal(), rng.normal()};
      int one = -1, other = -2;
      EXPECT_EQ(baseline::kChordKernels.farthest(points.data(), n, a, chord, &one),
                v3::kChordKernels.farthest(points.data(), n, a, chord, &other));
      EXPECT_EQ(one, other);
    }
}

}  // namespace
}  // namespace scanbench::extract
