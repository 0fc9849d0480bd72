// Distances between sets of pixels, compared with all pairs.
#include "metrics/raster/pixel_distances.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "core/rng.hpp"

namespace scanbench::metrics {
namespace {

std::vector<std::int64_t> by_all_pairs(const std::vector<Pixel>& from, const std::vector<Pixel>& to) {
  std::vector<std::int64_t> distances;
  for (const Pixel& p : from) {
    std::int64_t best = std::numeric_limits<std::int64_t>::max();
    for (const Pixel& q : to) {
      const std::int64_t dx = q.x - p.x, dy = q.y - p.y;
      best = std::min(best, dx * dx + dy * dy);
    }
    distances.push_back(best);
  }
  return distances;
}

std::vector<Pixel> random_pixels(std::uint32_t stream, int count, double side, double x0) {
  CounterRng rng(3, RngStream::pose, stream);
  std::set<Pixel> pixels;
  for (int i = 0; i < count; ++i)
    pixels.insert({.y = static_cast<std::int32_t>(side * (rng.uniform() - 0.5)),
                   .x = static_cast<std::int32_t>(x0 + side * rng.uniform())});
  return {pixels.begin(), pixels.end()};
}

TEST(PixelDistances, AreThoseOfAllPairs) {
  for (std::uint32_t k = 0; k < 100; ++k) {
    const auto from = random_pixels(2 * k, 1 + static_cast<int>(k), 60, 0);
    // Dense, sparse, overlapping, and wholly on either side.
    const auto to = random_pixels(2 * k + 1, 1 + static_cast<int>(k * k % 97), k % 3 == 0 ? 300 : 50,
                                  static_cast<double>(k % 5) * 40 - 80);
    EXPECT_EQ(squared_distances(from, to), by_all_pairs(from, to)) << "set " << k;
  }
}

TEST(PixelDistances, AreExactFarApart) {
  const std::vector<Pixel> here{{.y = -4000000, .x = -4000000}}, there{{.y = 4000000, .x = 4000000}};
  EXPECT_EQ(squared_distances(here, there), std::vector<std::int64_t>{std::int64_t{128} * 1000000000000});
  EXPECT_EQ(squared_distances(there, here), std::vector<std::int64_t>{std::int64_t{128} * 1000000000000});
}

TEST(PixelDistances, OfNothingAreNone) {
  const std::vector<Pixel> some{{.y = 1, .x = 1}};
  EXPECT_TRUE(squared_distances(some, {}).empty());
  EXPECT_TRUE(squared_distances({}, some).empty());
}

}  // namespace
}  // namespace scanbench::metrics
