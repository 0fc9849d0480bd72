// SEF: the count of jumps by brute force, and properties that follow from the definition.
#include <algorithm>

#include <gtest/gtest.h>

#include "algorithms/extract/parts/breakpoints.hpp"
#include "core/special_values.hpp"
#include "tests/support/extraction.hpp"
#include "tests/support/scan_lines_checks.hpp"
#include "tests/support/trace_recorder.hpp"

namespace scanbench {
namespace {

using support::beam_runs;
using support::OwnedScan;
using support::random_scan;

const ParamValue kSigmaOne = std::int64_t{1};

std::vector<std::pair<int, int>> runs_of(const OwnedScan& scan, const std::string& variant, double threshold) {
  return beam_runs(
      support::extract("sef", scan, {{"variant", variant}, {"threshold_m", threshold}, {"min_points", kSigmaOne}}));
}

// By definition: a run ends where the difference exceeds T.
std::vector<std::pair<int, int>> runs_by_hand(const OwnedScan& scan, bool points, double threshold) {
  std::vector<std::pair<int, int>> runs;
  const Scan view = scan.view();
  int first = 0;
  for (int i = 0; i + 1 < view.beams(); ++i) {
    const double jump =
        points ? (view.point(i + 1) - view.point(i)).norm() : std::fabs(view.ranges[i + 1u] - view.ranges[i + 0u]);
    if (jump > threshold) {
      runs.emplace_back(first, i);
      first = i + 1;
    }
  }
  runs.emplace_back(first, view.beams() - 1);
  return runs;
}

TEST(Sef, BreaksWhereNeighboursAreFartherApartThanTheThreshold) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const OwnedScan scan = random_scan(seed);
    for (const double t : {0.0, 0.03, 0.1, 0.3}) {
      EXPECT_EQ(runs_of(scan, "ranges", t), runs_by_hand(scan, false, t));
      EXPECT_EQ(runs_of(scan, "points", t), runs_by_hand(scan, true, t));
    }
  }
}

TEST(Sef, FewerRunsForALargerThresholdAndNeverFewerOnPointsThanOnRanges) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const OwnedScan scan = random_scan(seed);
    std::size_t before = 1000;
    for (const double t : {0.02, 0.06, 0.09, 0.12, 0.2, 0.5, 1e9}) {
      const std::size_t on_ranges = runs_of(scan, "ranges", t).size();
      EXPECT_LE(on_ranges, before);
      EXPECT_GE(runs_of(scan, "points", t).size(), on_ranges);
      before = on_ranges;
    }
    EXPECT_EQ(before, 1u);
  }
}

TEST(Sef, RangesRoundedToFiveCentimetresMakeSixAndNineTheSameThreshold) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    OwnedScan scan = random_scan(seed);
    for (double& r : scan.ranges) r = 0.05 * std::round(r / 0.05);
    EXPECT_EQ(runs_of(scan, "ranges", 0.06), runs_of(scan, "ranges", 0.09));
    EXPECT_EQ(runs_of(scan, "ranges", 0.12), runs_of(scan, "ranges", 0.14));
  }
}

// A plane 1 m away, seen until the beam hits it at 12 degrees.
OwnedScan grazing_plane() {
  SensorModel sensor;
  sensor.geometry = ScanGeometry(0.0, radians(0.5), 157);
  return support::cast(sensor, {{{1, -1}, {1, 100}}});
}

TEST(Sef, AConstantThresholdCutsAGrazingPlaneAndTheIncidenceAwareOneDoesNot) {
  const OwnedScan scan = grazing_plane();
  EXPECT_GT(runs_of(scan, "ranges", 0.05).size(), 1u);
  for (const double degrees : {10.0, 11.0}) {
    const ScanLines whole = support::extract(
        "sef", scan,
        {{"threshold", std::string("incidence")}, {"threshold_m", 1e-9}, {"beta_min_rad", radians(degrees)}});
    EXPECT_EQ(whole.lines.size(), 1u) << degrees;
  }
  const ScanLines cut = support::extract("sef", scan,
                                         {{"threshold", std::string("incidence")},
                                          {"threshold_m", 1e-9},
                                          {"beta_min_rad", radians(30)},
                                          {"min_points", kSigmaOne}});
  EXPECT_GT(cut.lines.size(), 1u);
}

TEST(Sef, TheLinearThresholdGrowsWithTheSmallerRange) {
  // Jumps of 0.1 at 1 m and at 10 m; T(r) = 0.05 + 0.01 r is 0.06 and 0.15.
  OwnedScan scan = support::constant_scan(support::fan_sensor(6, 0.1), 1.0);
  scan.ranges = {1.0, 1.1, 1.1, 10.0, 10.1, 10.1};
  const ScanLines lines = support::extract("sef", scan,
                                           {{"threshold", std::string("linear")},
                                            {"threshold_m", 0.05},
                                            {"threshold_per_m", 0.01},
                                            {"min_points", kSigmaOne}});
  EXPECT_EQ(beam_runs(lines), (std::vector<std::pair<int, int>>{{0, 0}, {1, 2}, {3, 5}}));
}

TEST(Sef, SinglePointsAreDroppedUnlessRequested) {
  OwnedScan scan = support::constant_scan(support::fan_sensor(5, 0.1), 1.0);
  scan.ranges = {1.0, 1.0, 3.0, 1.0, 1.0};
  EXPECT_EQ(support::extract("sef", scan).labels, (std::vector<int>{0, 0, -1, 1, 1}));
  EXPECT_EQ(support::extract("sef", scan, {{"min_points", kSigmaOne}}).labels, (std::vector<int>{0, 0, 1, 2, 2}));
}

TEST(AdaptiveBreakpoint, DistanceIsTheFormulaOfBorgesAndAldon2004) {
  SensorModel sensor;
  sensor.geometry = ScanGeometry(0.2, radians(0.6), 40);
  sensor.noise.sigma_m = 0.05;
  const std::vector<double> ranges(40, 4.0);
  const Scan scan{sensor, ranges};
  const extract::AdaptiveBreakpoint detector(radians(10));
  const double step = radians(0.6);
  for (const int gap : {1, 2, 5})  // missing beams do not widen the step: what they passed through is unknown
    EXPECT_NEAR(detector.max_distance(scan, 3, 3 + gap), 4.0 * std::sin(step) / std::sin(radians(10) - step) + 0.15,
                1e-9);
  EXPECT_EQ(detector.max_distance(scan, 3, 3 + 6), 0.0) << "five missing beams end a contour";
}

TEST(AdaptiveBreakpoint, APlaneMetAtMoreThanLambdaStaysWholeAtAnyRange) {
  const OwnedScan scan = grazing_plane();
  const ScanPoints points = valid_points(scan.view());
  EXPECT_EQ(runs_between_breakpoints(scan.view(), points, extract::AdaptiveBreakpoint(radians(10))).size(), 1u);
  EXPECT_GT(runs_between_breakpoints(scan.view(), points, extract::AdaptiveBreakpoint(radians(30))).size(), 1u);
}

TEST(Gaps, EndLinesByDistanceAndByMissingBeams) {
  OwnedScan scan = support::cast(support::fan_sensor(41, radians(40)), {{{2, -9}, {2, 9}}});
  scan.ranges[10] = kInf;
  scan.ranges[20] = scan.ranges[21] = kNaN;
  for (const std::string module : {"sef", "line_tracking", "iepf"}) {
    SCOPED_TRACE(module);
    const auto count = [&](const ParamSet& params) { return support::extract(module, scan, params).lines.size(); };
    EXPECT_EQ(count({}), 1u);
    EXPECT_EQ(count({{"max_missing_beams", std::int64_t{2}}}), 1u);
    EXPECT_EQ(count({{"max_missing_beams", std::int64_t{1}}}), 2u);
    EXPECT_EQ(count({{"max_missing_beams", std::int64_t{0}}}), 3u);
    // One degree at 2 m and at most 20 degrees from the normal is 3.5 to 4 cm; two steps 7 to 8, three 10.5 to 12.
    EXPECT_EQ(count({{"max_gap_m", 0.13}}), 1u);
    EXPECT_EQ(count({{"max_gap_m", 0.09}}), 2u);
    EXPECT_EQ(count({{"max_gap_m", 0.05}}), 3u);
  }
}

TEST(Stages, ArePreSegmentPostForTheThreeOfSiadat) {
  const OwnedScan scan = random_scan(1);
  for (const std::string module : {"sef", "line_tracking", "iepf"}) {
    support::TraceRecorder recorder("extract");
    Registry<LineExtractor>::make(module)->extract(scan.view(), recorder.trace);
    EXPECT_EQ(recorder.stages, (std::vector{Stage::pre, Stage::segment, Stage::post})) << module;
  }
}

}  // namespace
}  // namespace scanbench
