// The index of lines against a plain loop over all of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "algorithms/align/parts/line_grid.hpp"
#include "core/rng.hpp"

namespace scanbench::align {
namespace {

struct SeenLine {
  int scan;
  Segment segment;  ///< world frame
};

/// Distance from the line, positive on the left, if the reading may belong to it.
std::optional<double> by_definition(const Sighting& seen, const Segment& s, const PartnerRules& rules) {
  const Vec2 d = (s.b - s.a).normalized();
  const Vec2 left = perpendicular(d);
  const double distance = left.dot(seen.point - s.a);
  const double before_start = d.dot(s.a - seen.point), beyond_end = d.dot(seen.point - s.b);
  const bool near = std::abs(distance) <= rules.gate_m && std::max(before_start, beyond_end) <= rules.margin_m;
  const bool from_free_side = left.dot(seen.sensor - s.a) > 0;
  const bool towards = left.dot(seen.point - seen.sensor) < 0;
  const double angle = std::acos(std::clamp(d.dot(seen.surface), -1.0, 1.0));
  const bool aligned = seen.surface == Vec2(0, 0) || angle <= std::acos(rules.min_aligned);
  if (near && from_free_side && towards && aligned) return distance;
  return {};
}

class LineGridTest : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(WorldsOf, LineGridTest, ::testing::Values(2.0, 20.0, 2000.0));

TEST_P(LineGridTest, FindsTheNearestLineOfEachScanThatAPlainLoopFinds) {
  const double size = GetParam();
  CounterRng rng(7, RngStream::pose);
  const auto place = [&] { return Vec2(size * (rng.uniform() - 0.5), size * (rng.uniform() - 0.5)); };
  const PartnerRules widest{0.5, 0.2, -1.0};
  std::vector<SeenLine> lines;
  LineGrid grid(widest, 1.5 * size);
  for (int scan = 0; scan < 12; ++scan) {
    const Pose2 pose(place(), kTwoPi * rng.uniform());
    std::vector<Segment> in_sensor_frame;
    for (int k = 0; k < 15; ++k) {
      const Segment s{place(), place()};
      lines.push_back({scan, s});
      in_sensor_frame.push_back(pose.inverse() * s);
    }
    grid.add(scan, pose, in_sensor_frame);
  }

  int found = 0;
  for (int k = 0; k < 3000; ++k) {
    // Half of the points lie near a line, or in a large world hardly any would.
    const Segment& near = lines[static_cast<std::size_t>(k) % lines.size()].segment;
    const Vec2 at = near.a + (1.2 * rng.uniform() - 0.1) * (near.b - near.a);
    const Sighting seen{k % 2 == 0 ? place() : Vec2(at + Vec2(rng.uniform() - 0.5, rng.uniform() - 0.5)), place(),
                        k % 4 == 0 ? Vec2(0, 0) : Pose2(0, 0, kTwoPi * rng.uniform()).rotate({1, 0})};
    const PartnerRules rules{k % 3 == 0 ? 0.1 : 0.5, k % 5 == 0 ? 0.0 : 0.2, k % 7 == 0 ? 0.9 : 0.0};
    std::map<int, double> expected;
    for (const SeenLine& line : lines)
      if (const auto d = by_definition(seen, line.segment, rules))
        if (!expected.contains(line.scan) || std::abs(*d) < std::abs(expected[line.scan])) expected[line.scan] = *d;
    std::map<int, double> answer;
    int last = -1;
    grid.for_each_nearest(seen, rules, [&](const PlacedLine& line, double distance) {
      EXPECT_GT(line.scan, last) << "each scan once, ascending";
      last = line.scan;
      answer[line.scan] = distance;
    });
    ASSERT_EQ(answer.size(), expected.size());
    for (const auto& [scan, distance] : expected) EXPECT_NEAR(answer[scan], distance, 1e-9 * size) << "scan " << scan;
    found += static_cast<int>(expected.size());
  }
  EXPECT_GT(found, 200);
}

TEST(LineGrid, SkipsWhatIsNoLineOrTooFar) {
  const PartnerRules rules{0.5, 0.2, 0.5};
  LineGrid grid(rules, 4.0);
  const double nan = std::nan("");
  grid.add(0, {}, std::vector<Segment>{{{1, 1}, {1, 1}}, {{nan, 0}, {1, 0}}, {{0, 0}, {1e12, 0}}, {{-2, 0}, {2, 0}}});
  int calls = 0;
  const auto count = [&](const PlacedLine& line, double distance) {
    ++calls;
    EXPECT_EQ(line.length, 4.0);
    EXPECT_EQ(distance, 0.1);
  };
  grid.for_each_nearest({{0, 0.1}, {0, 1}}, rules, count);
  EXPECT_EQ(calls, 1);
  for (const double far : {nan, 1e10, -1e300, HUGE_VAL}) grid.for_each_nearest({{far, 0.1}, {0, 1}}, rules, count);
  EXPECT_EQ(calls, 1);
}

TEST(LineGrid, AWallIsSeenFromItsFreeSideOnly) {
  const PartnerRules rules{0.5, 0.2, 0.5};
  LineGrid grid(rules, 4.0);
  grid.add(3, {}, std::vector<Segment>{{{-2, 0}, {2, 0}}});  // free space above
  const auto partners = [&](const Vec2& point, const Vec2& sensor) {
    int n = 0;
    grid.for_each_nearest({point, sensor}, rules, [&](const PlacedLine&, double) { ++n; });
    return n;
  };
  EXPECT_EQ(partners({0, 0.1}, {0, 2}), 1);
  EXPECT_EQ(partners({0, -0.1}, {0, 2}), 1) << "a little behind the wall, by an error of the pose";
  EXPECT_EQ(partners({0, 0.1}, {0, -2}), 0) << "from behind";
  EXPECT_EQ(partners({1, 0.4}, {0, 0.3}), 0) << "from the free side, but looking away";
}

TEST(LineGrid, AWallIsForPointsOfSurfacesAlongIt) {
  const PartnerRules rules{0.5, 0.2, std::cos(radians(30))};
  LineGrid grid(rules, 4.0);
  grid.add(3, {}, std::vector<Segment>{{{-2, 0}, {2, 0}}});
  const auto partners = [&](const Vec2& surface) {
    int n = 0;
    grid.for_each_nearest({{0, 0.1}, {0, 2}, surface}, rules, [&](const PlacedLine&, double) { ++n; });
    return n;
  };
  EXPECT_EQ(partners({0, 0}), 1) << "not known";
  for (const double deg : {-29.0, 0.0, 29.0}) EXPECT_EQ(partners(Pose2(0, 0, radians(deg)).rotate({1, 0})), 1) << deg;
  for (const double deg : {-31.0, 31.0, 90.0, 180.0})
    EXPECT_EQ(partners(Pose2(0, 0, radians(deg)).rotate({1, 0})), 0) << deg;
}

}  // namespace
}  // namespace scanbench::align
