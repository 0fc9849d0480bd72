// The polygonal representation: its layout, its signs, and corners worked out by hand.
#include "core/geometry/polygon.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

#include "core/rng.hpp"

namespace scanbench {
namespace {

constexpr double kFloat = 1e-6;  // rounding of a 32-bit field that holds a few metres

LineFeature line_from(const Vec2& a, const Vec2& b, int points = 7) {
  LineFeature line;
  line.segment = {a, b};
  line.line = line_through(a, b);
  line.points = points;
  return line;
}

TEST(PolygonSegment, HasTheDocumentedLayout) {
  EXPECT_EQ(offsetof(PolygonSegment, v1), 0U);
  EXPECT_EQ(offsetof(PolygonSegment, v2), 8U);
  EXPECT_EQ(offsetof(PolygonSegment, direction), 16U);
  EXPECT_EQ(offsetof(PolygonSegment, normal), 24U);
  EXPECT_EQ(offsetof(PolygonSegment, length), 32U);
  EXPECT_EQ(offsetof(PolygonSegment, distance), 36U);
  EXPECT_EQ(offsetof(PolygonSegment, count), 40U);
  EXPECT_EQ(offsetof(PolygonSegment, flags), 44U);
  const PolygonSegment before = polygon_segment(line_from({2, -1}, {2, 1}));
  PolygonSegment after;
  std::memcpy(&after, &before, 48);
  EXPECT_EQ(after, before);
}

TEST(PolygonSegment, OfAWallTwoMetresAheadHasTheseFields) {
  const PolygonSegment wall = polygon_segment(line_from({2, -1}, {2, 3}, 41));
  EXPECT_EQ(wall.v1, (std::array{2.0F, -1.0F}));
  EXPECT_EQ(wall.v2, (std::array{2.0F, 3.0F}));
  EXPECT_EQ(wall.direction, (std::array{0.0F, 1.0F}));
  EXPECT_EQ(wall.normal, (std::array{1.0F, 0.0F}));
  EXPECT_EQ(wall.length, 4.0F);
  EXPECT_EQ(wall.distance, 2.0F);
  EXPECT_EQ(wall.count, 41U);
  EXPECT_EQ(wall.flags, PolygonSegment::valid);
  EXPECT_EQ(wall.oriented_distance({0, 0}), -2.0);
  EXPECT_EQ(wall.oriented_distance({1.5, 9}), -0.5);   // between the origin and the line
  EXPECT_EQ(wall.oriented_distance({2.25, 0}), 0.25);  // beyond it
}

TEST(PolygonSegment, KeepsSegmentAndLineOfAnySegment) {
  CounterRng rng(3, RngStream::pose, 0);
  const auto coordinate = [&] { return 20.0 * rng.uniform() - 10.0; };
  for (int i = 0; i < 500; ++i) {
    Vec2 a(coordinate(), coordinate());
    Vec2 b(coordinate(), coordinate());
    if (cross(a, b) < 0) std::swap(a, b);  // the sensor on the left
    const LineFeature line = line_from(a, b);
    const PolygonSegment r = polygon_segment(line);
    EXPECT_LT((r.segment().a - a).norm() + (r.segment().b - b).norm(), 20 * kFloat);
    const LineDifference d = line_difference(r.line(), line.line);
    EXPECT_LT(d.rho, 20 * kFloat);
    EXPECT_LT(d.alpha, kFloat);
    const Vec2 direction(r.direction[0], r.direction[1]);
    const Vec2 normal(r.normal[0], r.normal[1]);
    EXPECT_NEAR(direction.norm(), 1.0, kFloat);
    EXPECT_NEAR(normal.norm(), 1.0, kFloat);
    EXPECT_NEAR(normal.dot(direction), 0.0, kFloat);
    EXPECT_LT((r.segment().b - r.segment().a - r.length * direction).norm(), 30 * kFloat);
    EXPECT_NEAR(normal.dot(a), r.distance, 20 * kFloat);
    EXPECT_NEAR(normal.dot(b), r.distance, 20 * kFloat);
    EXPECT_GE(r.distance, 0.0F);
    EXPECT_EQ(r.oriented_distance({0, 0}), -r.distance);
    EXPECT_GT(r.oriented_distance(1.5 * line.segment.midpoint()), 0.0);
  }
}

TEST(PolygonSegment, OfASinglePointHasNoDirectionAndItsRayAsNormal) {
  LineFeature point;
  point.segment = {{3, 4}, {3, 4}};
  point.line = canonical(5.0, std::atan2(4.0, 3.0));
  point.points = 1;
  const PolygonSegment r = polygon_segment(point);
  EXPECT_EQ(r.flags, 0U);
  EXPECT_EQ(r.length, 0.0F);
  EXPECT_NEAR(r.distance, 5.0F, kFloat);
  EXPECT_NEAR(r.normal[0], 0.6F, kFloat);
  EXPECT_NEAR(r.normal[1], 0.8F, kFloat);
}

TEST(PolygonSegment, OnALineThroughTheOriginKeepsItsSegment) {
  const PolygonSegment r = polygon_segment(line_from({1, 1}, {2, 2}));
  EXPECT_EQ(r.distance, 0.0F);
  EXPECT_EQ(r.segment(), (Segment{{1, 1}, {2, 2}}));
  EXPECT_NEAR(std::abs(r.oriented_distance({0, 1})), std::sqrt(0.5), kFloat);
}

TEST(PolygonOf, JoinsACornerAtTheIntersectionOfItsLines) {
  // x = 2 up to y = 1.9, then y = 2 from x = 1.9 on: the corner is (2, 2).
  const ScanLines scan{{line_from({2, -1}, {2, 1.9}), line_from({1.9, 2}, {-1, 2})}, {}};
  const auto polygon = polygon_of(scan);
  ASSERT_EQ(polygon.size(), 2U);
  EXPECT_EQ(polygon[0].v2, (std::array{2.0F, 2.0F}));
  EXPECT_EQ(polygon[1].v1, (std::array{2.0F, 2.0F}));
  EXPECT_EQ(polygon[0].flags, PolygonSegment::valid | PolygonSegment::joined);
  EXPECT_EQ(polygon[1].flags, PolygonSegment::valid);
  EXPECT_EQ(polygon[0].length, 3.0F);
  EXPECT_EQ(polygon[0].distance, 2.0F);
}

TEST(PolygonOf, JoinsNearlyParallelNeighboursAtTheMidpoint) {
  const ScanLines scan{{line_from({2, -1}, {2, 0}), line_from({2.1, 0}, {2.1, 1})}, {}};
  const auto polygon = polygon_of(scan);
  EXPECT_FLOAT_EQ(polygon[0].v2[0], 2.05F);
  EXPECT_EQ(polygon[0].v2, polygon[1].v1);
  // The record follows its vertices: from (2, -1) to (2.05, 0).
  EXPECT_NEAR(polygon[0].direction[0], 0.05 / std::hypot(0.05, 1.0), kFloat);
  EXPECT_NEAR(polygon[0].distance, (2 + 0.05) / std::hypot(0.05, 1.0), kFloat);
}

TEST(PolygonOf, DoesNotJoinNeighboursAcrossAGap) {
  const ScanLines scan{{line_from({2, -1}, {2, 0}), line_from({2, 0.3}, {2, 1})}, {}};
  const auto polygon = polygon_of(scan);
  EXPECT_EQ(polygon[0], polygon_segment(scan.lines[0]));
  EXPECT_EQ(polygon[1], polygon_segment(scan.lines[1]));
  EXPECT_EQ(polygon_of(scan, {.gap_m = 0.31})[0].v2, (std::array{2.0F, 0.15F}));
}

TEST(PolygonOf, NoLinesIsEmpty) {
  EXPECT_TRUE(polygon_of({}).empty());
}

}  // namespace
}  // namespace scanbench
