// Lines as pixels, by the rules that core/contracts/line_raster.hpp states.
#include "core/contracts/line_raster.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/registry.hpp"
#include "core/rng.hpp"
#include "core/special_values.hpp"

namespace scanbench::render {
namespace {

std::vector<Pixel> pixels_of(const std::vector<Segment>& lines, double pixel_m = 1.0) {
  const std::vector<std::vector<Segment>> layers{lines};
  return Registry<LineRaster>::make(LineRaster::kDefault)->draw(layers, pixel_m).front();
}

TEST(LineRaster, SetsOnePixelPerColumnOfAFlatLine) {
  std::vector<Pixel> expected;
  for (int x = -3; x <= 7; ++x) expected.push_back({.y = 2, .x = x});
  EXPECT_EQ(pixels_of({{{-3, 2}, {7, 2}}}), expected);
  EXPECT_EQ(pixels_of({{{7.3, 2.4}, {-3.3, 2.4}}}), expected) << "from right to left, between the centres of rows";
  EXPECT_EQ(pixels_of({{{0.073, 0.024}, {-0.033, 0.024}}}, 0.01), expected);
}

TEST(LineRaster, SetsOnePixelPerRowOfASteepLine) {
  std::vector<Pixel> expected;
  for (int y = -600; y <= 600; ++y) expected.push_back({.y = y, .x = static_cast<int>(std::floor(y / 3.0 + 0.5))});
  EXPECT_EQ(pixels_of({{{-200, -600}, {200, 600}}}), expected);
}

TEST(LineRaster, SetsTheDiagonalOnce) {
  std::vector<Pixel> expected;
  for (int i = -1000; i <= 1000; ++i) expected.push_back({.y = -i, .x = i});
  std::ranges::sort(expected);
  EXPECT_EQ(pixels_of({{{-1000, 1000}, {1000, -1000}}, {{1000, -1000}, {-1000, 1000}}}), expected);
}

TEST(LineRaster, ShowsShortLinesAndSkipsThoseThatAreNotFinite) {
  const std::vector<Pixel> one{{.y = 4, .x = -2}};
  EXPECT_EQ(pixels_of({{{-2.2, 4.1}, {-2.1, 4.3}}}), one);
  EXPECT_EQ(pixels_of({{{-2.2, 4.1}, {-2.2, 4.1}}}), one);
  EXPECT_TRUE(pixels_of({{{kNaN, 0}, {1, 1}}, {{0, 0}, {kInf, 1}}}).empty());
  EXPECT_TRUE(pixels_of({}).empty());
}

TEST(LineRaster, LongLinesAreThinAndWithoutHolesAcrossTiles) {
  for (std::uint32_t k = 0; k < 400; ++k) {
    CounterRng rng(5, RngStream::pose, k);
    const Segment line{{4000 * (rng.uniform() - 0.5), 4000 * (rng.uniform() - 0.5)},
                       {4000 * (rng.uniform() - 0.5), 4000 * (rng.uniform() - 0.5)}};
    const bool steep = std::abs(line.b.y() - line.a.y()) > std::abs(line.b.x() - line.a.x());
    const Eigen::Index u = steep ? 1 : 0, v = 1 - u;
    const auto [low, high] = std::minmax(line.a[u], line.b[u]);
    int column = static_cast<int>(std::floor(low + 0.5));
    auto pixels = pixels_of({line});
    std::ranges::sort(pixels, {}, [&](const Pixel& p) { return steep ? p.y : p.x; });
    ASSERT_EQ(std::ssize(pixels), static_cast<int>(std::floor(high + 0.5)) - column + 1) << "line " << k;
    for (const Pixel& p : pixels) {
      EXPECT_EQ(steep ? p.y : p.x, column) << "line " << k;
      const double at = line.a[v] + (column++ - line.a[u]) * (line.b[v] - line.a[v]) / (line.b[u] - line.a[u]);
      EXPECT_NEAR(steep ? p.x : p.y, at, 0.5 + 1.0 / 256) << "line " << k;
    }
  }
}

TEST(LineRaster, KeepsLayersApart) {
  std::vector<std::vector<Segment>> layers;
  for (int i = 0; i < 5; ++i) layers.push_back({{{0, 0}, {9, 0}}, {{0.0 + i, -1}, {0.0 + i, 1}}});
  layers.insert(layers.begin() + 2, std::vector<Segment>{});
  const auto pixels = Registry<LineRaster>::make(LineRaster::kDefault)->draw(layers, 1.0);
  ASSERT_EQ(pixels.size(), 6u);
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    EXPECT_EQ(pixels[k], pixels_of(layers[k])) << "layer " << k;
    EXPECT_TRUE(std::ranges::is_sorted(pixels[k]));
  }
}

TEST(LineRaster, FarFromTheOriginPixelsAreTheSame) {
  const auto here = pixels_of({{{0.2, 0.1}, {40.7, 17.3}}});
  auto there = pixels_of({{{3000000.2, -3000000.0 + 0.1}, {3000040.7, -3000000.0 + 17.3}}});
  for (Pixel& p : there) p.x -= 3000000, p.y += 3000000;
  EXPECT_EQ(there, here);
}

}  // namespace
}  // namespace scanbench::render
