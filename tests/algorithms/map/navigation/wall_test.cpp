// Walls of the navigation map: the line of all points, the union of extents.
#include "algorithms/map/navigation/wall.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/matchers.hpp"

namespace scanbench::mapping::navigation {
namespace {

using support::SegmentNear;

std::vector<Vec2> along(const Segment& s, int n) {
  std::vector<Vec2> points;
  for (int k = 0; k < n; ++k) points.emplace_back(s.a + (s.b - s.a) * (static_cast<double>(k) / (n - 1)));
  return points;
}

TEST(Wall, UnitedIsTheFitOfAllPointsOverTheUnionOfTheExtents) {
  const Segment s{{0, 0}, {2, 0}}, t{{1, 0}, {4, 0}};
  const MapWall one = united(wall_of(s, along(s, 21)), wall_of(t, along(t, 31)));
  EXPECT_THAT(one.segment, SegmentNear(Segment{{0, 0}, {4, 0}}, 1e-12));
  EXPECT_EQ(one.points, 52);
  EXPECT_EQ(one.members, 2);
}

TEST(Wall, ManyPointsWeighMoreThanFew) {  // 30 points at y = 0, 10 at y = 0.04: the mean is 0.01
  const Segment s{{0, 0}, {2, 0}}, t{{0, 0.04}, {2, 0.04}};
  const MapWall one = united(wall_of(s, along(s, 30)), wall_of(t, along(t, 10)));
  EXPECT_NEAR(one.segment.midpoint().y(), 0.01, 1e-12);
}

TEST(Wall, UnitingDoesNotDependOnTheOrder) {
  const Segment s{{0, 0}, {2, 0.1}}, t{{1, 0.1}, {4, 0.15}}, u{{3, 0.1}, {5, 0.2}};
  const MapWall a = wall_of(s, along(s, 20)), b = wall_of(t, along(t, 30)), c = wall_of(u, along(u, 10));
  EXPECT_NEAR(fit_line(united(united(a, b), c).moments).offset, fit_line(united(a, united(b, c)).moments).offset, 1e-9);
}

TEST(SameSurface, NeedsSideDirectionOffsetAndTouch) {
  const UniteRule rule{.angle_rad = radians(10), .offset_m = 0.1, .gap_m = 0.2};
  const Segment s{{0, 0}, {3, 0}};
  EXPECT_TRUE(same_surface(s, {{1, 0.05}, {2, 0.05}}, rule));
  EXPECT_FALSE(same_surface(s, {{2, 0.05}, {1, 0.05}}, rule)) << "seen from the other side";
  EXPECT_FALSE(same_surface(s, {{1, 0.15}, {2, 0.15}}, rule)) << "too far across";
  EXPECT_TRUE(same_surface(s, {{3.15, 0.05}, {4, 0.05}}, rule)) << "a small gap";
  EXPECT_FALSE(same_surface(s, {{3.25, 0.05}, {4, 0.05}}, rule)) << "a door";
  EXPECT_FALSE(same_surface(s, {{1, 0}, {2, std::tan(radians(11))}}, rule)) << "another direction";
}

}  // namespace
}  // namespace scanbench::mapping::navigation
