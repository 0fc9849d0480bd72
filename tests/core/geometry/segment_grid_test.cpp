// The grid of segments compared with brute force.
#include "core/geometry/segment_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "core/geometry/angles.hpp"
#include "core/index.hpp"
#include "core/rng.hpp"
#include "core/special_values.hpp"

namespace scanbench {
namespace {

/// Segments of all lengths and directions, some of them axis-parallel, in a region of this size.
std::vector<Segment> random_segments(std::uint32_t seed, int n, const Vec2& size) {
  CounterRng rng(seed, RngStream::range);
  std::vector<Segment> segments;
  for (int i = 0; i < n; ++i) {
    const Vec2 a(size.x() * rng.uniform(), size.y() * rng.uniform());
    Vec2 b = a + size.maxCoeff() * rng.uniform() * rng.uniform() * Vec2(rng.normal(), rng.normal());
    if (i % 5 == 0) b.x() = a.x();
    if (i % 5 == 1) b.y() = a.y();
    segments.push_back({a, b});
  }
  return segments;
}

/// Smallest distance between two segments: 0 if they cross, else that of an end of one from the other.
double gap(const Segment& s, const Segment& t) {
  const auto side = [](const Segment& l, const Vec2& p) { return cross(Vec2(l.b - l.a), Vec2(p - l.a)); };
  if (side(s, t.a) * side(s, t.b) < 0 && side(t, s.a) * side(t, s.b) < 0) return 0.0;
  return std::min({distance(s.a, t), distance(s.b, t), distance(t.a, s), distance(t.b, s)});
}

const std::vector<Vec2> kSizes{{10, 10}, {1000, 3}, {0.5, 200}, {1e4, 0}};

TEST(SegmentGrid, VisitsEverySegmentNearAPath) {
  CounterRng rng(7, RngStream::range);
  for (const Vec2& size : kSizes)
    for (const int n : {1, 2, 17, 300}) {
      const std::vector<Segment> segments = random_segments(static_cast<std::uint32_t>(n), n, size);
      const SegmentGrid grid(segments);
      std::size_t near = 0;
      for (int k = 0; k < 200; ++k) {
        const auto place = [&] {
          return Vec2((1.4 * rng.uniform() - 0.2) * size.x(), (1.4 * rng.uniform() - 0.2) * size.y());
        };
        Segment path{place(), place()};
        if (k % 4 == 0) path.b = path.a;  // a pose
        if (k % 4 == 1) path.a = segments[as_index(k) % segments.size()].a;
        if (k % 4 == 2) path.b = path.a + 0.01 * (path.b - path.a);
        std::set<std::size_t> visited;
        grid.for_each_near(path, [&](std::size_t i) { visited.insert(i); });
        for (std::size_t i = 0; i < segments.size(); ++i) {
          if (gap(path, segments[i]) > 0.99 * SegmentGrid::kMarginM) continue;
          ++near;
          EXPECT_TRUE(visited.contains(i)) << "size " << size.transpose() << ", segment " << i << ", path " << k;
        }
      }
      EXPECT_GT(near, 0U);
    }
}

TEST(SegmentGrid, AgreesWithBruteForceInsideAndOutside) {
  CounterRng rng(3, RngStream::resampling);
  const auto uniform = [&](double low, double high) { return low + (high - low) * rng.uniform(); };
  for (const int count : {1, 2, 30, 400}) {
    std::vector<Segment> segments;
    for (int i = 0; i < count; ++i) {
      const Vec2 a(uniform(-20, 30), uniform(5, 15));
      const double length = i % 3 == 0 ? uniform(0, 25) : uniform(0, 1);
      // Some are horizontal, upright or a point: these are on the borders of cells.
      const double yaw = i % 5 == 0 ? 0.0 : i % 5 == 1 ? kPi / 2 : uniform(-3, 3);
      segments.push_back({a, i % 7 == 6 ? a : Vec2(a + length * Vec2(std::cos(yaw), std::sin(yaw)))});
    }
    segments.push_back({{0, 5}, {20, 5 + 1e-15}});
    const SegmentGrid grid(segments);
    for (int i = 0; i < 500; ++i) {
      const Vec2 p = i % 4 == 0 ? Vec2(uniform(-200, 200), uniform(-200, 200)) : Vec2(uniform(-25, 35), uniform(0, 20));
      double expected = kInf;
      for (const Segment& s : segments) expected = std::min(expected, distance(p, s));
      EXPECT_EQ(grid.distance(p), expected) << count << " segments, point " << p.transpose();
    }
  }
}

TEST(SegmentGrid, FindsSegmentsThatCrossFromRowToRowWithinARoundingError) {
  // Three segments in 3 m x 16 m make cells of sqrt(48 / 12) = 2 m; the third one is on the border of two rows.
  CounterRng rng(4, RngStream::resampling);
  for (int i = 0; i < 300; ++i) {
    const double bottom = 20 * rng.uniform();
    const double border = bottom + 2.0 * (1 + i % 7);
    const double below = border * (1 - (i % 3) * 2e-16);
    const double above = border * (1 + (i % 5) * 2e-16);
    const std::vector<Segment> segments{
        {{0, bottom}, {3, bottom}}, {{0, bottom + 16}, {3, bottom + 16}}, {{0, below}, {3, above}}};
    const SegmentGrid grid(segments);
    for (const double x : {0.1, 1.0, 1.9, 2.1, 2.9})
      for (const double dy : {-0.3, 0.3}) EXPECT_NEAR(grid.distance({x, border + dy}), 0.3, 1e-9);
  }
}

TEST(SegmentGrid, HasAnswersWithoutSegmentsAndForNonFiniteCoordinates) {
  const SegmentGrid nothing(std::vector<Segment>{});
  EXPECT_TRUE(nothing.empty());
  EXPECT_EQ(nothing.distance({0, 0}), kInf);
  nothing.for_each_near({{-5, 3}, {1e4, 7}}, [](std::size_t) { ADD_FAILURE(); });
  const double nan = kNaN;
  const SegmentGrid grid(std::vector<Segment>{{{0, 0}, {nan, 1}}, {{1, 0}, {1, 0}}});
  EXPECT_EQ(grid.distance({4, 4}), 5.0);
  EXPECT_TRUE(std::isnan(grid.distance({nan, 0})));
}

}  // namespace
}  // namespace scanbench
