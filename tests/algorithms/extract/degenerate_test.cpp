// The results of each line extractor, with its defaults, on scans with few or no lines: the claims of
// docs/algorithms/degenerate.md, one test per column. An extractor that is not in the table fails the first test.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/special_values.hpp"
#include "tests/support/extraction.hpp"
#include "tests/support/matchers.hpp"
#include "tests/support/scan_lines_checks.hpp"

namespace scanbench {
namespace {

using support::cast;
using support::OwnedScan;
using support::ring_sensor;
using support::with_noise;

struct Answer {
  int fewest_returns;              ///< in a row on one wall that become a line
  bool single_point;               ///< with min_points: 1, min_length_m: 0 a lone return becomes a segment of length 0
  std::optional<int> dense_walls;  ///< of the four of a room seen by 100 000 beams, 1 cm noise
  std::optional<int> lines_over_seam;  ///< of a wall that a full turn begins and ends on
};

// fewest_returns is the default of min_points, but for fuzzy_lines: 5 points in 4 clusters make one of two points. Its
// clusters in a room depend on their initialisation, so nothing is claimed. sef finds no corner of a closed room,
// because ranges do not jump there, and kovesi's contours end at every noisy pair of neighbours that are closer
// together than the noise.
const std::map<std::string, Answer> kAnswers = {
    {"em", {5, false, 4, 1}},
    {"fuzzy_lines", {5, true, {}, {}}},
    {"hough", {8, false, 4, 1}},
    {"iepf", {5, true, 4, 2}},
    {"incremental", {5, true, 4, 1}},
    {"kovesi", {5, true, 0, 2}},
    {"line_regression", {5, true, 4, 1}},
    {"line_tracking", {2, true, 4, 2}},
    {"optimal", {9, false, 4, 2}},
    {"polyline", {2, false, 4, 1}},
    {"ransac", {8, false, 4, 1}},
    {"sef", {2, true, 0, 0}},
    {"smf", {2, true, 4, 1}},
    {"split_and_merge", {5, true, 4, 1}},
};

class DegenerateScan : public ::testing::TestWithParam<std::string> {
 protected:
  const Answer& expected() const { return kAnswers.at(GetParam()); }
  ScanLines extract(const OwnedScan& scan, const ParamSet& params = {}) const {
    ScanLines result = support::extract(GetParam(), scan, params);
    support::expect_consistent(scan.view(), result);
    return result;
  }
};
INSTANTIATE_TEST_SUITE_P(All, DegenerateScan, ::testing::ValuesIn(Registry<LineExtractor>::names()),
                         [](const auto& test) { return test.param; });

// Only the beams first .. first + count - 1 of a wall two metres ahead.
OwnedScan returns_in_a_row(int count) {
  OwnedScan scan = with_noise(cast(support::fan_sensor(181, kPi), {{{2, -9}, {2, 9}}}), 0.005, 1);
  for (int i = 0; i < 181; ++i)
    if (i < 80 || i >= 80 + count) scan.ranges[static_cast<std::size_t>(i)] = kInf;
  return scan;
}

// A square room, the sensor in its middle; a full turn begins and ends on the wall x = -3.
OwnedScan square_room(int beams, std::uint64_t seed) {
  return with_noise(cast(ring_sensor(beams), support::box(-3, -3, 3, 3)), 0.01, seed);
}

// Lines that are the wall rho = 3, alpha, within 2 cm and one degree, with so many points at least.
int lines_of_wall(const ScanLines& result, double alpha, int points) {
  return static_cast<int>(std::ranges::count_if(result.lines, [&](const LineFeature& f) {
    const LineDifference d = line_difference(f.line, {3.0, alpha});
    return d.rho < 0.02 && d.alpha < radians(1.0) && f.points >= points;
  }));
}

TEST_P(DegenerateScan, HasADocumentedAnswer) {
  EXPECT_TRUE(kAnswers.contains(GetParam())) << "describe it in docs/algorithms/degenerate.md and in the table above";
}

TEST_P(DegenerateScan, FewReturnsInARowAreNoLineUntilThereAreEnough) {
  for (int count = 0; count < expected().fewest_returns; ++count)
    EXPECT_TRUE(extract(returns_in_a_row(count)).lines.empty()) << count << " returns";
  EXPECT_EQ(extract(returns_in_a_row(expected().fewest_returns)).lines.size(), 1U);
}

TEST_P(DegenerateScan, ALoneReturnIsASegmentOfNoLengthWhereAsked) {
  const ScanLines result = extract(returns_in_a_row(1), {{"min_points", std::int64_t{1}}, {"min_length_m", 0.0}});
  ASSERT_EQ(result.lines.size(), expected().single_point ? 1U : 0U);
  if (!expected().single_point) return;
  EXPECT_EQ(result.lines[0].points, 1);
  EXPECT_EQ(result.lines[0].segment.length(), 0.0);
  const OwnedScan scan = returns_in_a_row(1);
  EXPECT_THAT(result.lines[0].segment.a, support::PointNear(scan.view().point(80), 1e-9));
}

TEST_P(DegenerateScan, EqualPointsAreNoLine) {
  EXPECT_TRUE(extract(support::constant_scan(support::fan_sensor(50, 0.0), 2.0)).lines.empty());
}

TEST_P(DegenerateScan, WhyABeamHasNoReturnDoesNotMatter) {
  OwnedScan scan = square_room(361, 2);
  const auto lose = [&](double value) {
    for (std::size_t i = 7; i < scan.ranges.size(); i += 11) scan.ranges[i] = value;
    for (std::size_t i = 100; i < 130; ++i) scan.ranges[i] = value;
    return extract(scan);
  };
  const ScanLines lost = lose(kInf);
  for (const double value : {-kInf, kNaN, 0.0, -0.0, -1.0}) support::expect_identical(lost, lose(value));
}

TEST_P(DegenerateScan, TenBeamsOfARoomAreLinesOnlyWhereTwoOrThreePointsMayBeOne) {
  const ScanLines result = extract(square_room(10, 3));  // two or three beams per wall
  if (expected().fewest_returns > 3 && GetParam() != "fuzzy_lines")
    EXPECT_TRUE(result.lines.empty());
  else
    EXPECT_FALSE(result.lines.empty());
  for (const LineFeature& f : result.lines) EXPECT_GE(f.points, 2);
}

TEST_P(DegenerateScan, AHundredThousandBeamsShowTheWallsThatTheAnswerNames) {
  static const OwnedScan scan = square_room(100000, 4);
  const ScanLines result = extract(scan);
  int walls = 0;
  for (const double alpha : {0.0, kPi / 2, kPi, -kPi / 2}) walls += lines_of_wall(result, alpha, 10000) > 0 ? 1 : 0;
  EXPECT_EQ(walls, expected().dense_walls.value_or(walls));
}

TEST_P(DegenerateScan, AWallAcrossTheSeamIsOneLineOrTwoAsTheAnswerSays) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const int lines = lines_of_wall(extract(square_room(720, seed)), kPi, 60);
    EXPECT_EQ(lines, expected().lines_over_seam.value_or(lines)) << "seed " << seed;
  }
}

}  // namespace
}  // namespace scanbench
