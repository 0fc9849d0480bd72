// The spatial index against a search through all segments.
#include "core/geometry/segment_index.hpp"

#include <gtest/gtest.h>

#include <map>

#include "core/rng.hpp"

namespace scanbench {
namespace {

bool boxes_within(const Segment& s, const Segment& t, double reach) {
  for (const int k : {0, 1}) {
    const double low = std::max(std::min(s.a[k], s.b[k]), std::min(t.a[k], t.b[k]));
    const double high = std::min(std::max(s.a[k], s.b[k]), std::max(t.a[k], t.b[k]));
    if (low - high > reach) return false;
  }
  return true;
}

Segment random_segment(CounterRng& rng) {
  const Vec2 a(20 * rng.uniform(), 20 * rng.uniform());
  return {a, a + Vec2(4 * rng.uniform() - 2, 4 * rng.uniform() - 2)};
}

TEST(SegmentIndex, FindsWhatASearchThroughAllFindsWhileSegmentsComeAndGo) {
  SegmentIndex index;
  std::map<std::size_t, Segment> held;
  CounterRng rng(3, RngStream::pose);
  for (std::size_t k = 0; k < 400; ++k) {
    held[k] = random_segment(rng);
    index.insert(k, held[k]);
    if (k % 3 == 2) {
      index.erase(k / 2, held.contains(k / 2) ? held[k / 2] : Segment{});
      held.erase(k / 2);
    }
    const std::vector<Segment> places{random_segment(rng), random_segment(rng)};
    std::vector<std::size_t> expected;
    for (const auto& [number, segment] : held)
      if (boxes_within(segment, places[0], 0.5) || boxes_within(segment, places[1], 0.5)) expected.push_back(number);
    ASSERT_EQ(index.near(places, 0.5), expected) << k;
  }
}

TEST(SegmentIndex, AnEmptyIndexFindsNothing) {
  const SegmentIndex index;
  EXPECT_TRUE(index.near(std::vector<Segment>{{{0, 0}, {1, 1}}}, 100.0).empty());
}

}  // namespace
}  // namespace scanbench
