// Estimators of motion and maps: every registered aligner and mapper on inputs that determine nothing, and on the
// easiest one. Matchers: matcher_conformance_test.cpp.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "core/modules.hpp"
#include "core/registry.hpp"
#include "core/special_values.hpp"
#include "harness/study/conform/aligner_checks.hpp"
#include "tests/support/aligning.hpp"
#include "tests/support/matchers.hpp"
#include "tests/support/scan_builder.hpp"

namespace scanbench {
namespace {

using support::OwnedScan;
using support::ScanSeries;

// Every return is in a line, as in the papers.
const ParamSet kAllReturns{{"max_gap_m", 0.0}, {"min_points", std::int64_t{2}}};

// An observation that owns its scan, with the lines of an extractor that always exists.
struct Seen {
  explicit Seen(OwnedScan s) : scan(std::move(s)), scan_view(scan.view()) {
    Trace silent;
    lines = Registry<LineExtractor>::make("iepf", kAllReturns)->extract(scan_view, silent);
  }
  Seen(const Seen&) = delete;
  Observation view() const { return {scan_view, lines}; }

  OwnedScan scan;
  Scan scan_view;
  ScanLines lines;
};

OwnedScan room(const Pose2& pose) {
  auto walls = support::box(-3, -2, 4, 2.5);
  for (const Segment& s : support::polygon({{2, 1}, {2.6, 1.2}, {2.4, 1.8}, {1.8, 1.6}})) walls.push_back(s);
  return support::cast(support::ring_sensor(360), walls, pose);
}

OwnedScan nothing() {
  return support::constant_scan(support::ring_sensor(360), kInf);
}

bool finite(const Pose2& p) {
  return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.yaw());
}

class AlignerConformance : public ::testing::TestWithParam<std::string> {
 protected:
  Alignment align(const ScanSeries& scans, const std::vector<Pose2>& initial) const {
    Trace silent;
    const std::vector<Pose2> before = initial;
    const Alignment result = module_->align(scans.observations(), initial, silent);
    EXPECT_EQ(result.world_from_sensor.size(), initial.size());
    for (const Pose2& p : result.world_from_sensor) EXPECT_TRUE(finite(p));
    EXPECT_EQ(initial, before) << "input untouched";
    return result;
  }
  std::unique_ptr<Aligner> module_ = Registry<Aligner>::make(GetParam());
};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(AlignerConformance);
INSTANTIATE_TEST_SUITE_P(All, AlignerConformance, ::testing::ValuesIn(Registry<Aligner>::names()),
                         [](const auto& test) { return test.param; });

const std::vector<Pose2> kStops{{0, 0, 0}, {0.4, 0.1, 0.2}, {0.9, -0.2, 0.5}, {1.2, -0.6, 1.0}};

/// The poses at which the sensor stops according to its odometry.
std::vector<Pose2> believed() {
  std::vector<Pose2> poses = kStops;
  const std::vector<Pose2> errors{{0, 0, 0}, {0.05, -0.03, 0.02}, {-0.04, 0.06, -0.03}, {0.03, 0.05, 0.03}};
  for (std::size_t k = 0; k < poses.size(); ++k) poses[k] = poses[k] * errors[k];
  return poses;
}

ScanSeries of_each(const std::vector<OwnedScan>& scans) {
  ScanSeries series;
  for (const OwnedScan& scan : scans) series.add_extracted(scan, "iepf", kAllReturns);
  return series;
}

ScanSeries rooms(double sigma_m) {
  std::vector<OwnedScan> scans;
  for (std::size_t k = 0; k < kStops.size(); ++k)
    scans.push_back(support::with_noise(room(kStops[k]), sigma_m, 2, static_cast<std::uint32_t>(k)));
  return of_each(scans);
}

TEST_P(AlignerConformance, TheChecksOfConformArePassed) {
  const auto& entry = *Registry<Aligner>::find(GetParam());
  for (const auto& check : study::conform::aligner_checks()) {
    SCOPED_TRACE(check.name);
    study::conform::Findings findings;
    check.run({entry.params, entry.make}, findings);
    for (const auto& fault : findings.faults()) ADD_FAILURE() << fault;
  }
}

TEST_P(AlignerConformance, ScansWithoutReturnsAreAnsweredWithOnePoseEach) {
  const OwnedScan full = room({0, 0, 0});
  EXPECT_NE(align(of_each({nothing(), nothing(), nothing(), nothing()}), believed()).status, Status::converged);
  align(of_each({full, nothing(), full, nothing()}), believed());
  align(of_each({nothing(), full, nothing(), full}), believed());
}

TEST_P(AlignerConformance, ScansOfFaultyReadingsAreAnswered) {
  for (const double reading : {kNaN, kInf, -kInf, 0.0, -1.0, 1e300, 1e-300}) {
    OwnedScan odd = room({0, 0, 0});
    for (std::size_t i = 0; i < odd.ranges.size(); i += 3) odd.ranges[i] = reading;
    align(of_each({odd, odd, odd, odd}), believed());
    const OwnedScan all = support::constant_scan(support::ring_sensor(360), reading);
    align(of_each({all, all, odd, odd}), believed());
  }
}

TEST_P(AlignerConformance, ScansWithoutLinesAndWithOneWallAreAnswered) {
  ScanSeries no_lines;
  for (const Pose2& p : kStops) no_lines.add(room(p), {.lines = {}, .labels = std::vector<int>(360, -1)});
  align(no_lines, believed());
  std::vector<OwnedScan> walls;
  for (const Pose2& p : kStops) walls.push_back(support::cast(support::ring_sensor(360), {{{-3, -2}, {3, -2}}}, p));
  align(of_each(walls), believed());
  const OwnedScan full = room({0, 0, 0});
  align(of_each({full, full, full, full}), std::vector<Pose2>(4, Pose2(0.1, 0.2, 0.3)));
}

/// Aligners of points that are resampled along the lines, 10 cm apart by default: they pair points, not lines, so they
/// are exact to a fraction of that distance.
const std::set<std::string> kPointAligners = {"ffs", "simultaneous_icp", "virtual_scans"};

TEST_P(AlignerConformance, BringsScansOfARoomTogether) {
  const double distance = kPointAligners.contains(GetParam()) ? 0.025 : 0.01;
  const double angle = kPointAligners.contains(GetParam()) ? 0.01 : 0.005;
  const std::vector<Pose2> poses = align(rooms(0.0), believed()).world_from_sensor;
  for (std::size_t k = 0; k < kStops.size(); ++k) {
    const Pose2 off = (poses[0].inverse() * poses[k]).inverse() * (kStops[0].inverse() * kStops[k]);
    EXPECT_LT(off.translation().norm(), distance) << "scan " << k;
    EXPECT_THAT(off.yaw(), support::AngleNear(0.0, angle)) << "scan " << k;
  }
}

TEST_P(AlignerConformance, MovesWithTheWorldFrame) {
  const ScanSeries scans = rooms(0.01);
  const Pose2 elsewhere(12, -7, 2.2);
  std::vector<Pose2> moved;
  for (const Pose2& p : believed()) moved.push_back(elsewhere * p);
  const Alignment here = align(scans, believed()), there = align(scans, moved);
  EXPECT_EQ(here.status, there.status);
  for (std::size_t k = 0; k < kStops.size(); ++k) {
    const Pose2 expected = elsewhere * here.world_from_sensor[k];
    EXPECT_THAT(there.world_from_sensor[k].translation(), support::PointNear(expected.translation(), 1e-6));
    EXPECT_THAT(there.world_from_sensor[k].yaw(), support::AngleNear(expected.yaw(), 1e-6));
  }
}

}  // namespace
}  // namespace scanbench
