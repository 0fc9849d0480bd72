// Intervals by hand, and the part of a segment near another one against sampling.
#include "core/geometry/interval.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/rng.hpp"

namespace scanbench {
namespace {

TEST(Interval, OfAProjectionDoesNotDependOnTheOrderOfTheEnds) {
  const Vec2 along(0.6, 0.8);
  const Segment s{Vec2(1, 1) + 2 * along, Vec2(1, 1) + 5 * along + 7 * perpendicular(along)};
  for (const Segment& t : {s, Segment{s.b, s.a}}) {
    EXPECT_NEAR(projection(t, {1, 1}, along).low, 2.0, 1e-14);
    EXPECT_NEAR(projection(t, {1, 1}, along).high, 5.0, 1e-14);
  }
}

TEST(Interval, IntersectionsOfIntervalsThatAreApartHaveNegativeLength) {
  EXPECT_EQ(intersection({0, 2}, {1, 3}), (Interval{1, 2}));
  EXPECT_EQ(intersection({0, 4}, {1, 3}), (Interval{1, 3}));
  EXPECT_EQ(intersection({0, 1}, {3, 4}).length(), -2.0);
}

TEST(PartNear, IsTheIntervalThatSamplingFinds) {
  CounterRng rng(5, RngStream::resampling);
  const auto point = [&] { return Vec2(3 * rng.uniform(), 3 * rng.uniform()); };
  int found = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Segment probe{point(), point()};
    const Segment target{point(), trial % 3 == 0 ? point() : Vec2(probe.b + 0.1 * point())};
    const double d = 0.5 * rng.uniform();
    constexpr int kSamples = 2000;
    Interval sampled{1e9, -1e9};
    for (int i = 0; i <= kSamples; ++i) {
      const double t = probe.length() * i / kSamples;
      if (distance(probe.a + t * probe.direction(), target) > d) continue;
      sampled.low = std::min(sampled.low, t);
      sampled.high = std::max(sampled.high, t);
    }
    const auto part = part_near(probe, target, d);
    const double step = probe.length() / kSamples;
    if (sampled.high < sampled.low) {
      EXPECT_LE(part ? part->length() : 0.0, 1.001 * step);
      continue;
    }
    ++found;
    ASSERT_TRUE(part.has_value());
    EXPECT_NEAR(part->low, sampled.low, 1.001 * step);
    EXPECT_NEAR(part->high, sampled.high, 1.001 * step);
  }
  EXPECT_GT(found, 100);
}

TEST(Interval, UnionsAreDisjointAndHaveACommonLength) {
  const auto united = unite({{3, 4}, {0, 1}, {0.5, 2}, {2, 2}, {4, 5}});
  ASSERT_EQ(united.size(), 2u);
  EXPECT_EQ(total_length(united), 2.0 + 2.0);
  EXPECT_EQ(unite({{0, 1}, {1.2, 2}}, 0.3).size(), 1u);
  EXPECT_DOUBLE_EQ(common_length(united, std::vector<Interval>{{1.5, 3.5}, {4.5, 9}}), 0.5 + 0.5 + 0.5);
}

}  // namespace
}  // namespace scanbench
