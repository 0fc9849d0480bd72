// Extractors that promise the walls of a room: each visible wall once, in its place, also under noise and, if they
// claim it, across the seam of a full turn.
#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "algorithms/extract/parts/noise_scale.hpp"
#include "tests/support/extraction.hpp"
#include "tests/support/matchers.hpp"
#include "tests/support/scan_lines_checks.hpp"

namespace scanbench {
namespace {

using support::OwnedScan;

class Rooms : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, Rooms,
                         ::testing::Values("kovesi", "incremental", "split_and_merge", "line_regression", "ransac",
                                           "hough", "em"),
                         [](const auto& test) { return test.param; });

// An L-shaped room with a box, all walls well seen from the origin; the seam of the scan in the middle of a wall.
std::vector<Segment> l_room() {
  auto walls = support::polygon({{-2.5, -2}, {4, -2}, {4, 1.5}, {1.5, 1.5}, {1.5, 3.5}, {-2.5, 3.5}});
  for (const Segment& s : support::polygon({{1.8, -1.2}, {2.6, -1.2}, {2.6, -0.6}, {1.8, -0.6}})) walls.push_back(s);
  return walls;
}

// The lines that mostly come from wall w, by the walls of their beams.
std::map<int, std::vector<std::size_t>> lines_of_walls(const OwnedScan& scan, const ScanLines& lines) {
  std::map<int, std::vector<std::size_t>> result;
  for (std::size_t k = 0; k < lines.lines.size(); ++k) {
    std::map<int, int> votes;
    for (std::size_t i = 0; i < lines.labels.size(); ++i)
      if (lines.labels[i] == static_cast<int>(k)) ++votes[scan.ids[i]];
    const auto most = std::ranges::max_element(votes, {}, [](const auto& v) { return v.second; });
    // Up to four points, or a tenth, may come from the next wall at a corner.
    EXPECT_GE(most->second, lines.lines[k].points - std::max(4.0, 0.1 * lines.lines[k].points))
        << "line " << k << " mixes walls";
    result[most->first].push_back(k);
  }
  return result;
}

void expect_walls(const OwnedScan& scan, const std::vector<Segment>& walls, const ScanLines& lines, double offset_m,
                  double angle_rad) {
  const auto found = lines_of_walls(scan, lines);
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const auto seen = std::count(scan.ids.begin(), scan.ids.end(), static_cast<int>(w));
    if (seen < 12) continue;
    SCOPED_TRACE("wall " + std::to_string(w));
    const auto it = found.find(static_cast<int>(w));
    ASSERT_NE(it, found.end());
    int points = 0;
    for (const std::size_t k : it->second) {
      points += lines.lines[k].points;
      EXPECT_THAT(lines.lines[k].line, support::LineNear(line_through(walls[w].a, walls[w].b), offset_m, angle_rad));
    }
    EXPECT_GE(points, 0.9 * static_cast<double>(seen));
  }
}

TEST_P(Rooms, ANoiseFreeRoomGivesItsWalls) {
  const auto walls = l_room();
  const OwnedScan scan = support::cast(support::ring_sensor(720), walls);
  const ScanLines lines = support::extract(GetParam(), scan);
  expect_walls(scan, walls, lines, 0.02, radians(1));
}

TEST_P(Rooms, ANoisyRoomGivesItsWalls) {
  const auto walls = l_room();
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const OwnedScan scan = support::with_noise(support::cast(support::ring_sensor(720), walls), 0.01, seed);
    expect_walls(scan, walls, support::extract(GetParam(), scan), 0.06, radians(3));
  }
}

TEST(Seam, IsClosedByThoseThatMergeOnAFullTurn) {
  const auto walls = l_room();
  const OwnedScan scan = support::with_noise(support::cast(support::ring_sensor(720), walls), 0.005, 3);
  for (const std::string module : {"incremental", "split_and_merge", "line_regression", "ransac", "hough", "em"}) {
    const ScanLines lines = support::extract(module, scan);
    EXPECT_EQ(lines.labels.front(), lines.labels.back()) << module;
    EXPECT_GE(lines.labels.front(), 0) << module;
  }
}

TEST(Ransac, DependsOnItsSeedAlone) {
  const OwnedScan scan = support::random_scan(4);
  // One trial per line: with more trials the refinement gives nearly the same lines for every seed.
  const auto with = [&](std::int64_t seed) {
    return support::extract("ransac", scan, {{"seed", ParamValue(seed)}, {"trials", ParamValue(std::int64_t{1})}});
  };
  support::expect_identical(with(5), with(5));
  EXPECT_NE(with(5).labels, with(6).labels);
}

TEST(Kovesi, PiecesLieWithinToleranceOfTheirChordsAndWereTheLongestOnOffer) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const OwnedScan scan = support::random_scan(seed);
    // One contour: lambda so small that nothing breaks at these ranges.
    const ScanLines lines = support::extract(
        "kovesi", scan, {{"lambda_rad", 0.02}, {"min_points", ParamValue(std::int64_t{1})}, {"min_length_m", 0.0}});
    const ScanPoints points = valid_points(scan.view());
    // lineseg, transcribed: pull the end in until the chord fits.
    const auto deviation = [&](int a, int b, int& where) {
      const Vec2 d = points.points[static_cast<std::size_t>(b)] - points.points[static_cast<std::size_t>(a)];
      double most = -1;
      for (int i = a + 1; i < b; ++i) {
        const double off = std::fabs(cross(d, points.points[static_cast<std::size_t>(i)] -
                                                  points.points[static_cast<std::size_t>(a)])) /
                           d.norm();
        if (off > most) most = off, where = i;
      }
      return most;
    };
    std::vector<int> starts;
    const int n = static_cast<int>(points.size());
    for (int first = 0; first < n - 1;) {
      int last = n - 1, where = 0;
      while (deviation(first, last, where) > 0.05) last = where;
      starts.push_back(first);
      first = last;
    }
    std::vector<int> found;
    for (const auto& line : lines.lines) found.push_back(line.first_beam);
    EXPECT_EQ(found, starts);
  }
}

TEST(NoiseTolerance, IsANumberOfTheSensorsSigmasAboveAFloor) {
  SensorModel sensor;
  sensor.geometry = ScanGeometry(0, 0.01, 2);
  sensor.noise.sigma_relative = 0.01;
  const std::vector<double> ranges = {0.1, 4.0};
  const Scan scan{sensor, ranges};
  const extract::NoiseTolerance tolerance{3.0, 0.02};
  EXPECT_DOUBLE_EQ(tolerance(scan, 0), 0.02);
  EXPECT_DOUBLE_EQ(tolerance(scan, 1), 0.12);
}

TEST(ClearBreak, NeedsTwoNeighboursOffTheSameSide) {
  const LineFit axis = fit_line(std::vector<Vec2>{{0, 0}, {1, 0}});
  const std::vector<double> tolerance(5, 0.1);
  const auto breaks = [&](double a, double b) {
    const std::vector<Vec2> points = {{0, 0}, {1, 0}, {2, a}, {3, b}, {4, 0}};
    return extract::has_clear_break(points, tolerance, {0, 4}, axis);
  };
  EXPECT_FALSE(breaks(0.2, 0.0));
  EXPECT_FALSE(breaks(0.2, -0.2));
  EXPECT_TRUE(breaks(0.2, 0.2));
  EXPECT_TRUE(breaks(-0.2, -0.2));
}

}  // namespace
}  // namespace scanbench
