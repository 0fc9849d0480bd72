// Compares the fast caster with the reference over ten million rays and prints a Markdown table.
// tests/sim/caster_agreement_test.cpp makes the same comparison with a million rays.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fmt/format.h>

#include "core/geometry/pose2.hpp"
#include "core/rng.hpp"
#include "core/sensor_model.hpp"
#include "sim/ray_caster.hpp"
#include "sim/world.hpp"
#include "tests/sim/random_worlds.hpp"

namespace scanbench::sim {
namespace {

struct Counts {
  std::size_t rays = 0;
  std::size_t hits = 0;
  std::size_t other_surface = 0;  ///< within 1e-9 m: counts as a tie
  std::size_t wrong = 0;
  double largest_tie_m = 0.0;
};

void compare(const RayCaster& fast, const RayCaster& reference, const std::vector<Pose2>& poses,
             const ScanGeometry& beams, double range_max_m, Counts& counts) {
  const std::size_t n = poses.size() * static_cast<std::size_t>(beams.beams());
  std::vector<double> ranges(n);
  std::vector<double> expected_ranges(n);
  std::vector<std::int32_t> surfaces(n);
  std::vector<std::int32_t> expected_surfaces(n);
  fast.cast_scans(poses, {}, beams, range_max_m, {ranges, {}, {}, surfaces});
  reference.cast_scans(poses, {}, beams, range_max_m, {expected_ranges, {}, {}, expected_surfaces});
  counts.rays += n;
  for (std::size_t i = 0; i < n; ++i) {
    counts.hits += expected_surfaces[i] >= 0 ? 1 : 0;
    if (surfaces[i] == expected_surfaces[i] && ranges[i] == expected_ranges[i]) continue;
    const double difference = std::fabs(ranges[i] - expected_ranges[i]);
    if (surfaces[i] >= 0 && expected_surfaces[i] >= 0 && difference <= 1e-9) {
      ++counts.other_surface;
      counts.largest_tie_m = std::max(counts.largest_tie_m, difference);
    } else {
      ++counts.wrong;
    }
  }
}

void run(std::size_t rays) {
  CounterRng rng(1, RngStream::resampling);
  Counts counts;
  while (counts.rays < rays) {
    const double size = std::pow(10.0, -1.0 + 4.0 * rng.uniform());
    const int walls = static_cast<int>(std::pow(10.0, 4.0 * rng.uniform())) + 1;
    const World world = test::tangle(walls, size, rng);
    const RayCaster fast(world);
    const RayCaster reference(world, CasterKind::box2d);
    const std::vector<Pose2> poses = test::poses_in(world, size, 20, rng);
    for (const ScanGeometry& beams : test::geometries()) compare(fast, reference, poses, beams, 10.0 * size, counts);
  }
  fmt::print("| rays | hits | another surface within 1e-9 m | largest difference there | other differences |\n");
  fmt::print("|---|---|---|---|---|\n");
  fmt::print("| {} | {} | {} | {:.1e} m | {} |\n", counts.rays, counts.hits, counts.other_surface, counts.largest_tie_m,
             counts.wrong);
}

}  // namespace
}  // namespace scanbench::sim

int main() {
  scanbench::sim::run(10'000'000);
}
