// The cyclic histogram of directions and its peaks.
#include "algorithms/map/dse/main_directions.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/matchers.hpp"

namespace scanbench::mapping::dse {
namespace {

using support::DirectionNear;

const PeakRule kRule{.least_share = 0.10, .apart_rad = radians(10)};

Segment at_degrees(double direction_deg, double length = 1.0) {
  const double a = radians(direction_deg);
  return {{3, 4}, Vec2(3, 4) + length * Vec2(std::cos(a), std::sin(a))};
}

TEST(DirectionHistogram, TheTotalIsTheSumOfTheLengths) {
  DirectionHistogram histogram;
  for (int k = 0; k < 50; ++k) histogram.add(at_degrees(7.3 * k, 0.1 * k));
  EXPECT_NEAR(histogram.total_m(), 0.1 * 49 * 50 / 2, 1e-9);
  double sum = 0.0;
  for (int bin = 0; bin < DirectionHistogram::kBins; ++bin) sum += histogram.weight_m(bin);
  EXPECT_NEAR(sum, histogram.total_m(), 1e-9);
}

TEST(DirectionHistogram, AWindowOfFiveAroundBinOneIsCyclic) {
  DirectionHistogram histogram;
  for (const double direction : {178.0, 179.0, 0.0, 1.0, 2.0, 3.0, 4.0}) histogram.add(at_degrees(direction));
  EXPECT_NEAR(histogram.window_m(1), 5.0, 1e-12);  // 179, 0, 1, 2, 3
}

TEST(DirectionHistogram, ASegmentAndItsReverseAreOneDirection) {
  DirectionHistogram histogram;
  const Segment s = at_degrees(30);
  histogram.add(s);
  histogram.add({s.b, s.a});
  EXPECT_NEAR(histogram.weight_m(30), 2.0, 1e-12);
}

TEST(MainDirections, DirectionsOnBothSidesOfTheSeamAreOnePeakAtZero) {
  DirectionHistogram histogram;
  histogram.add(at_degrees(179.6));
  histogram.add(at_degrees(0.4));
  const auto peaks = main_directions(histogram, kRule);
  ASSERT_EQ(peaks.size(), 1u);
  EXPECT_THAT(peaks[0].angle_rad, DirectionNear(0.0, 1e-12));
}

TEST(MainDirections, AreOrderedByLengthAndAreTheMeansOfTheirSegments) {
  DirectionHistogram histogram;
  histogram.add(at_degrees(89.5, 3));
  histogram.add(at_degrees(90.5, 1));  // mean 89.75
  histogram.add(at_degrees(45.0, 2));
  const auto peaks = main_directions(histogram, kRule);
  ASSERT_EQ(peaks.size(), 2u);
  EXPECT_THAT(peaks[0].angle_rad, DirectionNear(radians(89.75), 1e-5));
  EXPECT_NEAR(peaks[0].weight_m, 4.0, 1e-12);
  EXPECT_THAT(peaks[1].angle_rad, DirectionNear(radians(45), 1e-12));
}

TEST(MainDirections, AShareBelowTheLeastIsNoPeak) {
  DirectionHistogram histogram;
  histogram.add(at_degrees(0, 9.2));
  histogram.add(at_degrees(45, 0.8));
  EXPECT_EQ(main_directions(histogram, kRule).size(), 1u);
  histogram.add(at_degrees(45, 0.4));  // 1.2 of 10.4
  EXPECT_EQ(main_directions(histogram, kRule).size(), 2u);
}

TEST(MainDirections, TurnWithTheSegments) {
  for (const int turn : {1, 17, 90, 171}) {
    DirectionHistogram straight, turned;
    for (const auto& [direction, length] : {std::pair(0.3, 5.0), {1.8, 2.0}, {62.0, 3.0}, {91.2, 4.0}}) {
      straight.add(at_degrees(direction, length));
      turned.add(at_degrees(direction + turn, length));
    }
    const auto a = main_directions(straight, kRule), b = main_directions(turned, kRule);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k)
      EXPECT_THAT(b[k].angle_rad, DirectionNear(a[k].angle_rad + radians(turn), 1e-9));
  }
}

TEST(MainDirections, ASlowDistortionOpensNoNewOne) {  // section 2.2: cumulative errors do not lead to peaks
  DirectionHistogram histogram;
  for (int k = 0; k < 20; ++k) {
    histogram.add(at_degrees(0.1 * k));
    histogram.add(at_degrees(90 + 0.1 * k));
  }
  EXPECT_EQ(main_directions(histogram, kRule).size(), 2u);
}

TEST(MainDirections, AllDirectionsEqualIsOnePeakAndNoneIsNone) {
  DirectionHistogram histogram;
  EXPECT_TRUE(main_directions(histogram, kRule).empty());
  histogram.add({{1, 1}, {1, 1}});
  EXPECT_TRUE(main_directions(histogram, kRule).empty());
  for (int k = 0; k < 10; ++k) histogram.add(at_degrees(33.2));
  const auto peaks = main_directions(histogram, kRule);
  ASSERT_EQ(peaks.size(), 1u);
  EXPECT_THAT(peaks[0].angle_rad, DirectionNear(radians(33.2), 1e-12));
}

}  // namespace
}  // namespace scanbench::mapping::dse
