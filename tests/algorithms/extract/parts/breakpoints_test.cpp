// Adaptive breakpoints: the formula of Borges & Aldon 2004 between neighbours, and no surface through free space.
#include "algorithms/extract/parts/breakpoints.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/index.hpp"
#include "tests/support/extraction.hpp"

namespace scanbench {
namespace {

using extract::AdaptiveBreakpoint;
using support::OwnedScan;

const double kStep = radians(0.5);
const double kLambda = radians(10.0);

// D_max of the paper, written with angles.
double limit_of_the_paper(double r, double step) {
  return r * std::sin(step) / std::sin(kLambda - step);
}

OwnedScan fan(int beams, double range) {
  return support::constant_scan(support::fan_sensor(beams, (beams - 1) * kStep), range);
}

TEST(AdaptiveBreakpoint, BetweenNeighboursIsTheFormulaOfThePaper) {
  const AdaptiveBreakpoint detector(kLambda);
  for (const double r : {0.5, 3.0, 20.0})
    EXPECT_NEAR(detector.max_distance(fan(41, r).view(), 7, 8), limit_of_the_paper(r, kStep), 1e-12 * r);
}

TEST(AdaptiveBreakpoint, MissingBeamsNeverWidenTheLimit) {
  const AdaptiveBreakpoint detector(kLambda);
  const OwnedScan scan = fan(41, 3.0);
  const double one_step = limit_of_the_paper(3.0, kStep);
  for (int next = 2; next <= 40; ++next)
    EXPECT_LE(detector.max_distance(scan.view(), 0, next), one_step * (1 + 1e-12)) << next - 1 << " missing beams";
}

TEST(AdaptiveBreakpoint, AWallThatFacesTheSensorSurvivesFourLostReturnsAndAnOpeningEndsIt) {
  for (const int missing : {1, 4, 5, 16}) {
    OwnedScan scan = support::cast(support::fan_sensor(61, 60 * kStep), {{{3, -9}, {3, 9}}});
    for (int i = 0; i < missing; ++i) scan.ranges[as_index(25 + i)] = kInf;
    const auto runs = runs_between_breakpoints(scan.view(), valid_points(scan.view()), AdaptiveBreakpoint(kLambda));
    EXPECT_EQ(runs.size(), missing <= AdaptiveBreakpoint::kMostMissingBeams ? 1u : 2u) << missing << " missing beams";
  }
}

class Contours : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, Contours,
                         ::testing::Values("kovesi", "incremental", "split_and_merge", "line_regression"),
                         [](const auto& test) { return test.param; });

// Two walls on one line through free space, nearly along the beams: one from 1.9 to 2.2 m, the other behind it.
TEST_P(Contours, DoNotContinueThroughFreeSpace) {
  const Vec2 direction(std::cos(radians(14)), std::sin(radians(14)));
  const Vec2 begin(1.85, -0.1);
  OwnedScan scan = support::cast(support::fan_sensor(41, 40 * kStep), {{begin, begin + 20.0 * direction}});
  int seen = 0;
  for (int i = 0; i < 41; ++i) seen += std::isfinite(scan.ranges[as_index(i)]);
  ASSERT_GE(seen, 26);
  const int first = 41 - seen;
  for (int i = first + 6; i < first + 6 + 16; ++i) scan.ranges[as_index(i)] = kInf;
  scan.sensor.noise.sigma_m = 0.01;
  const ScanLines lines = support::extract(GetParam(), scan, {{"min_points", std::int64_t{2}}, {"min_length_m", 0.0}});
  ASSERT_FALSE(lines.lines.empty());
  for (const LineFeature& line : lines.lines)
    EXPECT_FALSE(line.first_beam < first + 6 && line.last_beam >= first + 22)
        << "a line from beam " << line.first_beam << " to " << line.last_beam << ", " << line.segment.length() << " m";
}

}  // namespace
}  // namespace scanbench
