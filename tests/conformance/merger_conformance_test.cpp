// Every registered segment merger, with its defaults, on segment sets that break careless implementations.
#include <algorithm>
#include <map>
#include <numeric>

#include <gtest/gtest.h>

#include "core/modules.hpp"
#include "core/registry.hpp"
#include "core/special_values.hpp"
#include "tests/support/matchers.hpp"
#include "tests/support/scan_builder.hpp"

namespace scanbench {
namespace {

using testing::SegmentNear;

// Mergers whose answer may depend on the order of the segments, and why.
const std::map<std::string, std::string> kOrderDependent = {};

class MergerConformance : public ::testing::TestWithParam<std::string> {
 protected:
  MergeResult merge(const std::vector<MapLine>& lines, const std::vector<Vec2>& points = {}) const {
    Trace silent;
    MergeResult result = module_->merge({lines, points}, silent);
    check(lines, result);
    return result;
  }

  static void check(const std::vector<MapLine>& lines, const MergeResult& result) {
    ASSERT_EQ(result.labels.size(), lines.size());
    for (const auto* clusters : {&result.cluster1, &result.cluster2}) {
      EXPECT_TRUE(clusters->empty() || clusters->size() == lines.size());
      for (const int c : *clusters) EXPECT_GE(c, -1);
    }
    std::vector<int> members(result.map.lines.size(), 0);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const int label = result.labels[i];
      ASSERT_GE(label, -1);
      ASSERT_LT(label, static_cast<int>(result.map.lines.size()));
      const bool finite = lines[i].segment.a.allFinite() && lines[i].segment.b.allFinite();
      if (!finite) {
        EXPECT_EQ(label, -1) << "a segment that is not finite is dropped";
      }
      if (label >= 0) members[static_cast<std::size_t>(label)] += 1;
    }
    for (std::size_t k = 0; k < result.map.lines.size(); ++k) {
      const MapLine& line = result.map.lines[k];
      EXPECT_TRUE(line.segment.a.allFinite() && line.segment.b.allFinite());
      EXPECT_TRUE(line.covariance.allFinite());
      EXPECT_GE(line.members, 1);
      EXPECT_GE(line.points, 0);
      EXPECT_GE(members[k], 1) << "map line " << k << " has no member";
    }
  }

  std::unique_ptr<SegmentMerger> module_ = Registry<SegmentMerger>::make(GetParam());
};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(MergerConformance);
INSTANTIATE_TEST_SUITE_P(All, MergerConformance, ::testing::ValuesIn(Registry<SegmentMerger>::names()),
                         [](const auto& test) { return test.param; });

MapLine line(double x1, double y1, double x2, double y2) {
  MapLine result;
  result.segment = {{x1, y1}, {x2, y2}};
  result.points = 10;
  return result;
}

// The walls of a room, each seen `copies` times with noise of `sigma` at both ends.
std::vector<MapLine> seen_room(int copies, double sigma, std::uint64_t seed) {
  std::vector<MapLine> lines;
  const auto walls = testing::box(-3, -2, 4, 2.5);
  for (std::size_t w = 0; w < walls.size(); ++w)
    for (int c = 0; c < copies; ++c) {
      CounterRng rng(seed, RngStream::range, static_cast<std::uint32_t>(c), static_cast<std::uint32_t>(w));
      const auto jitter = [&] { return Vec2(sigma * rng.normal(), sigma * rng.normal()); };
      const Segment& s = walls[w];
      const Vec2 a = s.a + jitter();
      const Vec2 b = s.b + jitter();
      lines.push_back(line(a.x(), a.y(), b.x(), b.y()));
    }
  return lines;
}

// Both maps have the same segments, in any order.
void expect_same_map(const LineMap& a, const LineMap& b, double tolerance) {
  ASSERT_EQ(a.lines.size(), b.lines.size());
  for (const MapLine& x : a.lines) {
    const bool found = std::ranges::any_of(
        b.lines, [&](const MapLine& y) { return ::testing::Matches(SegmentNear(x.segment, tolerance))(y.segment); });
    EXPECT_TRUE(found) << "no counterpart of (" << x.segment.a.transpose() << ") - (" << x.segment.b.transpose() << ")";
  }
}

TEST_P(MergerConformance, NoSegmentsGiveAnEmptyMap) {
  const MergeResult result = merge({});
  EXPECT_TRUE(result.map.lines.empty());
}

TEST_P(MergerConformance, OneSegmentIsAnswered) {
  EXPECT_LE(merge({line(1, 1, 3, 2)}).map.lines.size(), 1u);
}

TEST_P(MergerConformance, IdenticalSegmentsBecomeOneInTheirPlace) {
  const MergeResult result = merge(std::vector<MapLine>(8, line(1, 1, 3, 2)));
  ASSERT_EQ(result.map.lines.size(), 1u);
  const Segment& s = result.map.lines[0].segment;
  const Segment truth{{1, 1}, {3, 2}};
  EXPECT_THAT(line_through(s.a, s.b), testing::LineNear(line_through(truth.a, truth.b), 1e-3, 1e-3));
  EXPECT_LE(distance(s.midpoint(), truth), 1e-3);
  EXPECT_EQ(std::count(result.labels.begin(), result.labels.end(), 0), 8);
}

TEST_P(MergerConformance, SegmentsWithoutLengthAreAnswered) {
  merge({line(1, 1, 1, 1)});
  merge(std::vector<MapLine>(5, line(1, 1, 1, 1)));
  auto lines = seen_room(4, 0.01, 1);
  lines.push_back(line(0, 0, 0, 0));
  merge(lines);
}

TEST_P(MergerConformance, SegmentsThatAreNotFiniteAreDroppedAndChangeNothingElse) {
  auto lines = seen_room(5, 0.01, 2);
  const MergeResult clean = merge(lines);
  for (const double bad : {kNaN, kInf, -kInf}) {
    lines.push_back(line(bad, 0, 1, 1));
    lines.push_back(line(0, 0, 1, bad));
  }
  const MergeResult result = merge(lines);
  expect_same_map(clean.map, result.map, 1e-9);
}

TEST_P(MergerConformance, TheOrderOfTheSegmentsDoesNotMatter) {
  if (const auto found = kOrderDependent.find(GetParam()); found != kOrderDependent.end())
    GTEST_SKIP() << found->second;
  const auto lines = seen_room(6, 0.01, 3);
  const MergeResult straight = merge(lines);
  std::vector<MapLine> shuffled;
  for (std::size_t i = 0; i < lines.size(); ++i) shuffled.push_back(lines[(i * 7) % lines.size()]);  // gcd(7, 24) = 1
  const MergeResult other = merge(shuffled);
  expect_same_map(straight.map, other.map, 1e-4);
}

TEST_P(MergerConformance, TheMapMovesWithTheSegments) {
  const auto lines = seen_room(6, 0.01, 4);
  const MergeResult before = merge(lines);
  const Pose2 motion(3.0, -1.0, 0.4);
  std::vector<MapLine> moved = lines;
  for (MapLine& l : moved) l.segment = motion * l.segment;
  const MergeResult after = merge(moved);
  LineMap expected = before.map;
  for (MapLine& l : expected.lines) l.segment = motion * l.segment;
  expect_same_map(expected, after.map, 1e-3);
}

TEST_P(MergerConformance, TheAnswerIsTheSameTwice) {
  const auto lines = seen_room(6, 0.02, 5);
  const MergeResult first = merge(lines);
  for (const MergeResult& other : {merge(lines), [&] {
                                     Trace silent;
                                     return Registry<SegmentMerger>::make(GetParam())->merge({lines, {}}, silent);
                                   }()}) {
    EXPECT_EQ(first.labels, other.labels);
    ASSERT_EQ(first.map.lines.size(), other.map.lines.size());
    for (std::size_t k = 0; k < first.map.lines.size(); ++k)
      EXPECT_TRUE(first.map.lines[k].segment == other.map.lines[k].segment);
  }
}

}  // namespace
}  // namespace scanbench
