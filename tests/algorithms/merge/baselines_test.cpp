// The baselines of segment merging: matching chains and greedy pairs.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/rng.hpp"
#include "tests/support/merging.hpp"
#include "tests/support/spiral.hpp"

namespace scanbench {
namespace {

using support::apart;
using support::line;
using support::merge;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class MergeBaseline : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, MergeBaseline, ::testing::Values("amigoni_chain", "greedy_pairs"));

TEST_P(MergeBaseline, GivesASegmentItselfAndEqualSegmentsOnce) {
  for (const double angle : {0.0, 0.5, kPi / 2, kPi - 1e-9}) {
    const MapLine one = line(3, 4, 3 + 2 * std::cos(angle), 4 + 2 * std::sin(angle));
    for (const std::size_t n : {1U, 5U, 20000U}) {
      const MergeResult r = merge(GetParam(), std::vector<MapLine>(n, one));
      ASSERT_EQ(r.map.lines.size(), 1U);
      EXPECT_LT(apart(r.map.lines[0].segment, one.segment), 1e-9);
      EXPECT_EQ(r.map.lines[0].members, static_cast<int>(n));
    }
  }
}

TEST_P(MergeBaseline, MergesOverlappingParallelSegmentsAndNoOthers) {
  const std::vector<MapLine> lines{line(0, 0, 1, 0), line(1.9, 0.02, 0.5, 0.02), line(2.5, 0, 3, 0),
                                   line(0, 0.5, 1, 0.5), line(0.5, -0.5, 0.5, 0.4)};
  const MergeResult r = merge(GetParam(), lines);
  ASSERT_EQ(r.map.lines.size(), 4U);
  EXPECT_EQ(r.labels[0], r.labels[1]);
  const MapLine& merged = r.map.lines[static_cast<std::size_t>(r.labels[0])];
  EXPECT_EQ(merged.members, 2);
  EXPECT_NEAR(std::min(merged.segment.a.x(), merged.segment.b.x()), 0.0, 1e-9);
  EXPECT_NEAR(std::max(merged.segment.a.x(), merged.segment.b.x()), 1.9, 1e-9);
  EXPECT_NEAR(merged.segment.a.y(), 0.02 * 1.4 / 2.4, 1e-9);  // weighted with length
  EXPECT_EQ(merge(GetParam(), lines, {{"max_gap_m", 0.7}}).map.lines.size(), 3U);
}

TEST_P(MergeBaseline, MatchesAcrossTheSeamOfDirections) {
  const double small = radians(2.0);
  const std::vector<MapLine> lines{line(0, 0, std::cos(small), std::sin(small)),
                                   line(0, 0, std::cos(small), -std::sin(small))};
  const MergeResult r = merge(GetParam(), lines);
  ASSERT_EQ(r.map.lines.size(), 1U);
  EXPECT_NEAR(std::abs(r.map.lines[0].segment.direction().x()), 1.0, 1e-9);
}

TEST_P(MergeBaseline, FindsMatchesOfVeryLongSegmentsAnywhereAlongThem) {
  const std::vector<MapLine> lines{line(0, 0, 1000, 0), line(700.1, 0.01, 700.2, 0.01), line(999.9, 0.05, 1001, 0.05)};
  EXPECT_EQ(merge(GetParam(), lines).map.lines.size(), 1U);
}

TEST_P(MergeBaseline, DependsNeitherOnTheOrderNorOnTheSenseOfTheSegments) {
  const auto lines = support::spiral();
  const MergeResult plain = merge(GetParam(), lines);
  CounterRng rng(2, RngStream::pose);
  std::vector<std::size_t> order(lines.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[rng.bits() % i]);
  std::vector<MapLine> shuffled;
  for (const std::size_t i : order) shuffled.push_back({.segment = {lines[i].segment.b, lines[i].segment.a}});
  const MergeResult r = merge(GetParam(), shuffled);
  ASSERT_EQ(r.map.lines.size(), plain.map.lines.size());
  for (std::size_t k = 0; k < r.map.lines.size(); ++k)
    EXPECT_LT(apart(r.map.lines[k].segment, plain.map.lines[k].segment), 1e-9);
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(r.labels[i], plain.labels[order[i]]);
}

TEST_P(MergeBaseline, AnswersBadInputWithAStatus) {
  EXPECT_EQ(merge(GetParam(), {}).status, Status::converged);
  const MergeResult useless = merge(GetParam(), {line(1, 1, 1, 1), line(kNan, 0, 1, 0), line(0, 0, 1e300, 0)});
  EXPECT_EQ(useless.status, Status::degenerate);
  EXPECT_EQ(useless.labels, std::vector<int>(3, -1));
  const MergeResult mixed = merge(GetParam(), {line(1, 1, 1, 1), line(0, 0, 1, 0)});
  EXPECT_EQ(mixed.labels, (std::vector<int>{-1, 0}));
  EXPECT_THROW(Registry<SegmentMerger>::make(GetParam(), {{"max_angle_deg", -1.0}}), ParamError);
}

// Lakaemper 2009, section II: dissimilarities accumulate along a chain. Neighbours on the spiral's outer turn differ by
// about 20 degrees, which is also the angle that mean shift separates with its defaults (it returns 30, see the spiral
// test): with that tolerance the chain winds up the outer turn. It takes a tolerance below that to keep the segments
// apart.
TEST(AmigoniChain, OverMergesTheSpiralAtTheToleranceAtWhichMeanShiftDoesNot) {
  const auto lines_at = [](const char* name, double angle_deg) {
    return merge(name, support::spiral(), {{"max_angle_deg", angle_deg}}).map.lines.size();
  };
  EXPECT_EQ(lines_at("amigoni_chain", 10), 30U);
  EXPECT_LT(lines_at("amigoni_chain", 20), 25U);
  EXPECT_LT(lines_at("amigoni_chain", 30), 15U);
  EXPECT_EQ(lines_at("greedy_pairs", 20), 30U);
}

// Three segments in a row, each 8 degrees on from the last: a chain joins what no pair of ends would.
TEST(AmigoniChain, JoinsSegmentsThatDoNotMatchEachOther) {
  std::vector<MapLine> lines;
  for (const double deg : {0.0, 8.0, 16.0}) {
    const double angle = radians(deg);
    lines.push_back(line(-std::cos(angle), -std::sin(angle), std::cos(angle), std::sin(angle)));
  }
  EXPECT_EQ(merge("amigoni_chain", lines).map.lines.size(), 1U);
  EXPECT_EQ(merge("greedy_pairs", lines).map.lines.size(), 2U);
}

}  // namespace
}  // namespace scanbench
