// Generalized polylines: order, flips and cuts.
#include "algorithms/map/dse/polylines.hpp"

#include <gtest/gtest.h>

namespace scanbench::mapping::dse {
namespace {

TEST(GeneralizedPolylines, KeepsTheOrderOfASeenContour) {
  const std::vector<Segment> seen{{{0, 0}, {1, 0}}, {{1.1, 0}, {1.1, 1}}, {{1, 1.1}, {0, 1.1}}};
  const auto lines = generalized_polylines(seen, 0.5);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0], (Polyline{{0, false}, {1, false}, {2, false}}));
  EXPECT_EQ(vertices(seen, lines, 0.05), 6);
  EXPECT_EQ(vertices(seen, lines, 0.2), 4);  // both gaps are closed
}

TEST(GeneralizedPolylines, FlipsASegmentWhoseFarEndComesFirst) {
  const std::vector<Segment> given{{{0, 0}, {1, 0}}, {{1, 1}, {1, 0}}};
  const auto lines = generalized_polylines(given, 0.5);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0][1], (Link{1, true}));
}

TEST(GeneralizedPolylines, AGapBeyondTheLimitEndsAPolyline) {
  const std::vector<Segment> given{{{0, 0}, {1, 0}}, {{1.6, 0}, {2, 0}}, {{2.2, 0}, {3, 0}}};
  EXPECT_EQ(generalized_polylines(given, 0.5).size(), 2u);
  EXPECT_EQ(generalized_polylines(given, 0.7).size(), 1u);
  EXPECT_EQ(generalized_polylines(given, 0.1).size(), 3u);
}

TEST(GeneralizedPolylines, ReordersSegmentsByTheNearestEnd) {
  const std::vector<Segment> given{{{0, 0}, {1, 0}}, {{2, 0}, {3, 0}}, {{1, 0}, {2, 0}}};
  const auto lines = generalized_polylines(given, 0.5);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0], (Polyline{{0, false}, {2, false}, {1, false}}));
}

TEST(GeneralizedPolylines, OfNothingAreNone) {
  EXPECT_TRUE(generalized_polylines({}, 0.5).empty());
}

}  // namespace
}  // namespace scanbench::mapping::dse
