// Every registered line extractor, with its defaults, on scans that break careless implementations. New modules are
// tested as soon as they register themselves.
#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "core/modules.hpp"
#include "core/registry.hpp"
#include "core/special_values.hpp"
#include "tests/support/matchers.hpp"
#include "tests/support/scan_builder.hpp"
#include "tests/support/scan_lines_checks.hpp"
#include "tests/support/trace_recorder.hpp"

namespace scanbench {
namespace {

using testing::cast;
using testing::constant_scan;
using testing::expect_consistent;
using testing::expect_identical;
using testing::fan_sensor;
using testing::LineNear;
using testing::OwnedScan;
using testing::PointNear;
using testing::ring_sensor;
using testing::with_noise;

// Extractors whose answer may change when the scene rotates about the sensor, and why.
const std::map<std::string, std::string> kNotRotationEquivariant = {
    {"hough", "its accumulator has fixed angles"},
};

// Extractors that may make several lines of one wall, and why.
const std::map<std::string, std::string> kSeveralLinesPerWall = {
    {"fuzzy_lines", "the number of lines is its parameter"},
};

class ExtractorConformance : public ::testing::TestWithParam<std::string> {
 protected:
  ScanLines extract(const OwnedScan& scan) const {
    Trace silent;
    ScanLines result = module_->extract(scan.view(), silent);
    expect_consistent(scan.view(), result);
    return result;
  }
  std::unique_ptr<LineExtractor> module_ = Registry<LineExtractor>::make(GetParam());
};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(ExtractorConformance);
INSTANTIATE_TEST_SUITE_P(All, ExtractorConformance, ::testing::ValuesIn(Registry<LineExtractor>::names()),
                         [](const auto& test) { return test.param; });

OwnedScan noisy_room(std::uint64_t seed, int beams = 361) {
  return with_noise(cast(ring_sensor(beams), testing::random_room(seed)), 0.01, seed);
}

TEST_P(ExtractorConformance, AScanWithoutBeamsHasNoLines) {
  EXPECT_TRUE(extract(constant_scan(fan_sensor(0, 1.0), 1.0)).lines.empty());
}

TEST_P(ExtractorConformance, AScanWithoutReturnsHasNoLines) {
  for (const double nothing : {kInf, -kInf, kNaN, 0.0, -1.0})
    EXPECT_TRUE(extract(constant_scan(fan_sensor(181, kPi), nothing)).lines.empty()) << nothing;
}

TEST_P(ExtractorConformance, OneTwoAndThreeReturnsAreAnswered) {
  for (int returns = 1; returns <= 3; ++returns) {
    OwnedScan scan = constant_scan(fan_sensor(181, kPi), kInf);
    for (int i = 0; i < returns; ++i) scan.ranges[static_cast<std::size_t>(60 + 3 * i)] = 2.0 + 0.1 * i;
    EXPECT_LE(extract(scan).lines.size(), static_cast<std::size_t>(returns));
  }
  EXPECT_LE(extract(constant_scan(fan_sensor(1, 1.0), 2.0)).lines.size(), 1u);
}

TEST_P(ExtractorConformance, EqualPointsAreAnswered) {
  extract(constant_scan(fan_sensor(50, 0.0), 2.0));  // all beams in one direction
  extract(constant_scan(ring_sensor(360), 1e-12));   // all points practically at the sensor
}

TEST_P(ExtractorConformance, ACircleIsAnswered) {
  extract(constant_scan(ring_sensor(360), 2.0));
}

TEST_P(ExtractorConformance, AWallSeenEdgeOnIsAnswered) {
  // All points on one ray, and neighbours on two opposite rays.
  OwnedScan scan = constant_scan(fan_sensor(50, 0.0), 1.0);
  for (std::size_t i = 0; i < 50; ++i) scan.ranges[i] += 0.05 * static_cast<double>(i);
  extract(scan);
  extract(cast(ring_sensor(360), {{{-5, 1e-7}, {5, -1e-7}}}));
}

TEST_P(ExtractorConformance, ANoiseFreeWallIsOneLineInItsPlace) {
  const OwnedScan scan = cast(fan_sensor(91, radians(90)), {{{2, -9}, {2, 9}}});
  const ScanLines result = extract(scan);
  ASSERT_GE(result.lines.size(), 1u);
  for (const auto& line : result.lines) EXPECT_THAT(line.line, LineNear(PolarLine{2.0, 0.0}, 1e-3, 1e-3));
  if (kSeveralLinesPerWall.contains(GetParam())) return;
  ASSERT_EQ(result.lines.size(), 1u);
  EXPECT_EQ(result.lines[0].points, 91);
  EXPECT_THAT(result.lines[0].segment.a, PointNear(Vec2(2, -2), 2e-3));
  EXPECT_THAT(result.lines[0].segment.b, PointNear(Vec2(2, 2), 2e-3));
}

TEST_P(ExtractorConformance, AClockwiseScannerGivesTheSameWallWithTheSensorOnItsLeft) {
  SensorModel sensor;
  sensor.geometry = ScanGeometry(radians(45), -radians(1), 91);
  const ScanLines result = extract(cast(sensor, {{{2, -9}, {2, 9}}}));
  ASSERT_GE(result.lines.size(), 1u);
  for (const auto& line : result.lines) {
    EXPECT_THAT(line.line, LineNear(PolarLine{2.0, 0.0}, 1e-3, 1e-3));
    EXPECT_LT(line.segment.a.y(), line.segment.b.y());
  }
}

TEST_P(ExtractorConformance, ACornerIsAnswered) {
  const ScanLines result = extract(cast(fan_sensor(91, radians(90)), {{{2, -3}, {2, 0.5}}, {{2, 0.5}, {-3, 0.5}}}));
  EXPECT_GE(result.lines.size(), 1u);
}

TEST_P(ExtractorConformance, AWallAcrossTheSeamOfAFullTurnIsFoundOnBothSides) {
  const OwnedScan scan = cast(ring_sensor(360), {{{-2, -2}, {-2, 2}}});
  const ScanLines result = extract(scan);
  ASSERT_GE(result.lines.size(), 1u);
  for (const auto& line : result.lines) EXPECT_THAT(line.line, LineNear(PolarLine{2.0, kPi}, 1e-3, 1e-3));
  EXPECT_GE(result.labels.front(), 0);
  EXPECT_GE(result.labels.back(), 0);
}

TEST_P(ExtractorConformance, TenBeamsAreAnswered) {
  extract(cast(ring_sensor(10), testing::box(-2, -2, 2, 2)));
}

TEST_P(ExtractorConformance, AHundredThousandBeamsAreAnswered) {
  static const OwnedScan scan = noisy_room(3, 100000);
  EXPECT_GE(extract(scan).lines.size(), 1u);
}

TEST_P(ExtractorConformance, RoomsWithHolesAreAnswered) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    OwnedScan scan = noisy_room(seed);
    CounterRng rng(seed, RngStream::dropout);
    for (double& r : scan.ranges) {
      const double u = rng.uniform();
      if (u < 0.05) r = kInf;
      if (u > 0.95) r = kNaN;
      if (u > 0.45 && u < 0.5) r *= rng.uniform();  // spurious short returns
    }
    EXPECT_GE(extract(scan).lines.size(), 1u);
  }
}

TEST_P(ExtractorConformance, HugeAndTinyScenesAreAnswered) {
  for (const double scale : {1e-6, 1e-3, 1e3, 1e6}) {
    OwnedScan scan = noisy_room(5);
    for (double& r : scan.ranges) r *= scale;
    extract(scan);
  }
}

TEST_P(ExtractorConformance, TheLinesTurnWithTheSceneAboutTheSensor) {
  if (const auto found = kNotRotationEquivariant.find(GetParam()); found != kNotRotationEquivariant.end())
    GTEST_SKIP() << found->second;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const double angle = 0.3 + 1.1 * static_cast<double>(seed);
    const OwnedScan scan = noisy_room(seed);
    const ScanLines before = extract(scan);
    const ScanLines after = extract(testing::turned(scan, angle));
    EXPECT_EQ(before.labels, after.labels);
    ASSERT_EQ(before.lines.size(), after.lines.size());
    const Pose2 turn(0, 0, angle);
    for (std::size_t k = 0; k < before.lines.size(); ++k) {
      EXPECT_THAT(after.lines[k].line, LineNear(transform(turn, before.lines[k].line), 1e-6, 1e-6));
      EXPECT_THAT(after.lines[k].segment, testing::SegmentNear(turn * before.lines[k].segment, 1e-6));
      EXPECT_NEAR(after.lines[k].rms_m, before.lines[k].rms_m, 1e-6);
    }
  }
}

TEST_P(ExtractorConformance, TheAnswerIsTheSameTwiceAndFromASecondInstanceAndWithATraceThatListens) {
  const OwnedScan scan = noisy_room(6);
  const ScanLines first = extract(scan);
  expect_identical(first, extract(scan));
  extract(noisy_room(7));
  expect_identical(first, extract(scan));
  Trace silent;
  expect_identical(first, Registry<LineExtractor>::make(GetParam())->extract(scan.view(), silent));
  testing::TraceRecorder recorder("extract");
  expect_identical(first, module_->extract(scan.view(), recorder.trace));
}

TEST_P(ExtractorConformance, TheInputIsNotTouched) {
  const OwnedScan scan = noisy_room(8);
  const std::vector<double> copy = scan.ranges;
  extract(scan);
  EXPECT_EQ(scan.ranges, copy);
}

// Every choice, both values of a switch, and every closed bound, one at a time.
TEST_P(ExtractorConformance, EveryParameterAtItsEndsGivesAConsistentAnswer) {
  const auto& entry = *Registry<LineExtractor>::find(GetParam());
  const OwnedScan room = noisy_room(9, 120);
  const OwnedScan nothing = constant_scan(ring_sensor(120), kInf);
  Trace silent;
  for (const ParamSpec& spec : entry.params) {
    std::vector<ParamValue> values;
    if (spec.type == scanbench::ParamType::boolean) values = {true, false};
    for (const auto& choice : spec.choices) values.emplace_back(choice);
    for (const double bound : {spec.bounds.min, spec.bounds.max}) {
      if (!std::isfinite(bound) || (bound == spec.bounds.min && spec.bounds.open_min)) continue;
      if (spec.type == scanbench::ParamType::number) values.emplace_back(bound);
      if (spec.type == scanbench::ParamType::integer) values.emplace_back(static_cast<std::int64_t>(bound));
    }
    for (const ParamValue& value : values) {
      SCOPED_TRACE(spec.name + " = " + to_text(value));
      const auto module = entry.make({{spec.name, value}});
      expect_consistent(room.view(), module->extract(room.view(), silent));
      expect_consistent(nothing.view(), module->extract(nothing.view(), silent));
    }
  }
}

}  // namespace
}  // namespace scanbench
