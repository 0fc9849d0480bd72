// Estimators of motion and maps: every registered matcher, aligner and mapper on inputs with nothing to hold on to, and
// on the easiest one.
#include <gtest/gtest.h>

#include "core/modules.hpp"
#include "core/registry.hpp"
#include "tests/support/matchers.hpp"
#include "tests/support/scan_builder.hpp"

namespace scanbench {
namespace {

using testing::OwnedScan;

// An observation that owns its scan, with lines by the extractor that is always there.
struct Seen {
  explicit Seen(OwnedScan s) : scan(std::move(s)), scan_view(scan.view()) {
    Trace silent;
    lines = Registry<LineExtractor>::make("iepf")->extract(scan_view, silent);
  }
  Seen(const Seen&) = delete;
  Observation view() const { return {scan_view, lines}; }

  OwnedScan scan;
  Scan scan_view;
  ScanLines lines;
};

OwnedScan room(const Pose2& pose) {
  auto walls = testing::box(-3, -2, 4, 2.5);
  for (const Segment& s : testing::polygon({{2, 1}, {2.6, 1.2}, {2.4, 1.8}, {1.8, 1.6}})) walls.push_back(s);
  return testing::cast(testing::ring_sensor(360), walls, pose);
}

OwnedScan nothing() {
  return testing::constant_scan(testing::ring_sensor(360), testing::kInf);
}

bool finite(const Pose2& p) {
  return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.yaw());
}

class MatcherConformance : public ::testing::TestWithParam<std::string> {
 protected:
  Match match(const Seen& reference, const Seen& current, const Pose2& guess) const {
    Trace silent;
    const Match result = module_->match(reference.view(), current.view(), guess, silent);
    EXPECT_TRUE(finite(result.reference_from_current));
    EXPECT_TRUE(result.covariance.allFinite());
    return result;
  }
  std::unique_ptr<ScanMatcher> module_ = Registry<ScanMatcher>::make(GetParam());
};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(MatcherConformance);
INSTANTIATE_TEST_SUITE_P(All, MatcherConformance, ::testing::ValuesIn(Registry<ScanMatcher>::names()),
                         [](const auto& test) { return test.param; });

TEST_P(MatcherConformance, AScanWithoutReturnsDoesNotMatch) {
  const Seen empty(nothing()), full(room({0, 0, 0}));
  const Pose2 guess(0.1, 0.2, 0.3);
  EXPECT_NE(match(empty, empty, guess).status, Status::converged);
  EXPECT_NE(match(full, empty, guess).status, Status::converged);
  EXPECT_NE(match(empty, full, guess).status, Status::converged);
}

TEST_P(MatcherConformance, AScanMatchesItselfWhereItIs) {
  const Seen full(room({0, 0, 0.2}));
  const Match result = match(full, full, {});
  EXPECT_NEAR(result.reference_from_current.x(), 0.0, 5e-3);
  EXPECT_NEAR(result.reference_from_current.y(), 0.0, 5e-3);
  EXPECT_THAT(result.reference_from_current.yaw(), testing::AngleNear(0.0, 5e-3));
}

TEST_P(MatcherConformance, TheAnswerIsTheSameTwice) {
  const Seen a(room({0, 0, 0})), b(room({0.1, 0.05, 0.03}));
  EXPECT_EQ(match(a, b, {}).reference_from_current, match(a, b, {}).reference_from_current);
}

class AlignerConformance : public ::testing::TestWithParam<std::string> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(AlignerConformance);
INSTANTIATE_TEST_SUITE_P(All, AlignerConformance, ::testing::ValuesIn(Registry<Aligner>::names()),
                         [](const auto& test) { return test.param; });

TEST_P(AlignerConformance, NoneOneAndEmptyScansAreAnsweredWithOnePoseEach) {
  const auto module = Registry<Aligner>::make(GetParam());
  Trace silent;
  EXPECT_TRUE(module->align({}, {}, silent).world_from_sensor.empty());
  const Seen full(room({0, 0, 0})), empty(nothing());
  const std::vector<Pose2> poses = {Pose2(0, 0, 0), Pose2(0.1, 0, 0)};
  const std::vector<Observation> one = {full.view()};
  EXPECT_EQ(module->align(one, std::span(poses).first(1), silent).world_from_sensor.size(), 1u);
  const std::vector<Observation> two = {full.view(), empty.view()};
  const Alignment result = module->align(two, poses, silent);
  ASSERT_EQ(result.world_from_sensor.size(), 2u);
  for (const Pose2& p : result.world_from_sensor) EXPECT_TRUE(finite(p));
}

class MapperConformance : public ::testing::TestWithParam<std::string> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(MapperConformance);
INSTANTIATE_TEST_SUITE_P(All, MapperConformance, ::testing::ValuesIn(Registry<Mapper>::names()),
                         [](const auto& test) { return test.param; });

TEST_P(MapperConformance, AMapWithoutScansIsEmptyAndAScanWithoutReturnsAddsNothing) {
  const auto module = Registry<Mapper>::make(GetParam());
  Trace silent;
  EXPECT_TRUE(module->map().lines.empty());
  const Seen empty(nothing());
  module->insert(empty.view(), {}, silent);
  EXPECT_TRUE(module->map().lines.empty());
  const Seen full(room({0, 0, 0}));
  module->insert(full.view(), {}, silent);
  EXPECT_FALSE(module->map().lines.empty());
  for (const MapLine& line : module->map().lines) EXPECT_TRUE(line.segment.a.allFinite() && line.segment.b.allFinite());
}

}  // namespace
}  // namespace scanbench
