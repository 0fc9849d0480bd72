// Mean-shift merging of segments (Lakaemper 2009): what must hold by mathematics or by the paper.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/rng.hpp"
#include "tests/support/merging.hpp"

namespace scanbench {
namespace {

using support::apart;
using support::line;

constexpr double kModeSigma = 0.20;
constexpr double kNoLimit = std::numeric_limits<double>::infinity();

MergeResult merge_lines(const std::vector<MapLine>& lines, const ParamSet& params = {},
                        const std::vector<Vec2>& points = {}) {
  return support::merge("mean_shift", lines, params, points);
}

/// A line by centre, direction and length.
MapLine centred(const Vec2& centre, double direction_rad, double length = 0.3) {
  const Vec2 half = 0.5 * length * Vec2(std::cos(direction_rad), std::sin(direction_rad));
  return {.segment = {centre - half, centre + half}};
}

/// Lines of a room seen several times with noise: walls of many lengths and directions.
std::vector<MapLine> noisy_walls(std::uint64_t seed) {
  const std::vector<Segment> walls{{{0, 0}, {4, 0.1}},     {{4, 0.1}, {4.3, 3}},    {{4.3, 3}, {2.5, 3.2}},
                                   {{2.5, 3.2}, {2.4, 5}}, {{2.4, 5}, {-0.3, 4.8}}, {{-0.3, 4.8}, {0, 0}},
                                   {{1, 1}, {1.6, 1.4}},   {{2, 1}, {2.5, 2.2}}};
  CounterRng rng(seed, RngStream::pose);
  std::vector<MapLine> lines;
  for (int scan = 0; scan < 6; ++scan)
    for (const Segment& wall : walls) {
      const double from = 0.3 * rng.uniform();
      const double to = 1.0 - 0.3 * rng.uniform();
      const Pose2 error(0.01 * rng.normal(), 0.01 * rng.normal(), 0.005 * rng.normal());
      lines.push_back({.segment = error * Segment{wall.a + from * (wall.b - wall.a), wall.a + to * (wall.b - wall.a)}});
    }
  return lines;
}

const ParamSet kStrictRules{{"labelling", std::string("strict")}, {"split_length_sigma", 1000.0}};
ParamSet strict_and(const std::string& name, ParamValue value) {
  ParamSet set = kStrictRules;
  set[name] = std::move(value);
  return set;
}
/// Phase 1 alone: every phase-2 cluster of these is whole in cluster1.
int number_of_clusters(const std::vector<int>& labels) {
  return *std::max_element(labels.begin(), labels.end()) + 1;
}

TEST(MeanShift, Phase1HasOneModeForTwoParallelSegmentsOnlyWithinTwoSigma) {
  const ParamSet tight = strict_and("epsilon_sigma", 0.05);
  for (const double direction : {0.0, 0.7, 2.9}) {
    const Vec2 across(-std::sin(direction), std::cos(direction));
    for (const Vec2& axis : {across, perpendicular(across)}) {
      const auto at = [&](double sigmas) {
        return merge_lines({centred({1, 2}, direction), centred(Vec2(1, 2) + sigmas * kModeSigma * axis, direction)},
                           tight);
      };
      EXPECT_EQ(number_of_clusters(at(1.9).cluster1), 1) << direction;
      EXPECT_EQ(number_of_clusters(at(2.1).cluster1), 2) << direction;
    }
  }
}

TEST(MeanShift, Phase1HasOneModeForTwoDirectionsInOnePlaceOnlyWithinTwentyDegrees) {
  const ParamSet tight = strict_and("epsilon_sigma", 0.05);
  for (const double first_deg : {0.0, 35.0, 90.0, 161.0, 170.0, 175.0}) {  // the last ones: across the seam at 180
    const auto at = [&](double difference_deg) {
      return merge_lines({centred({1, 2}, radians(first_deg)), centred({1, 2}, radians(first_deg + difference_deg))},
                         tight);
    };
    EXPECT_EQ(number_of_clusters(at(19).cluster1), 1) << first_deg;
    EXPECT_EQ(number_of_clusters(at(21).cluster1), 2) << first_deg;
  }
}

TEST(MeanShift, TheBandwidthFollowsSigmaUnlessItIsSet) {
  const auto lines = [](double deg) { return std::vector{centred({0, 0}, 0.0), centred({0, 0}, radians(deg))}; };
  ParamSet half = strict_and("sigma_m", 0.10);
  EXPECT_EQ(number_of_clusters(merge_lines(lines(19), half).cluster1), 1);
  EXPECT_EQ(number_of_clusters(merge_lines(lines(21), half).cluster1), 2);
  half["h_deg_per_m"] = 50.0;  // now 5 degrees for sigma
  EXPECT_EQ(number_of_clusters(merge_lines(lines(9.5), half).cluster1), 1);
  EXPECT_EQ(number_of_clusters(merge_lines(lines(10.5), half).cluster1), 2);
}

// K2 has standard deviations 2 sigma along and sigma / 10 across the cluster's direction; two equal Gaussians are one
// up to twice that. The centres are at most 2 sigma apart, so phase 1 keeps them together.
TEST(MeanShift, Phase2MergesAlongTheDirectionOfTheClusterAndNotAcrossIt) {
  for (const double direction_deg : {0.0, 30.0, 90.0, 120.0, 150.0}) {
    const double direction = radians(direction_deg);
    const Vec2 along(std::cos(direction), std::sin(direction));
    const Vec2 across = perpendicular(along);
    const auto clusters_at = [&](const Vec2& offset, double factor) {
      ParamSet params = kStrictRules;
      params["kernel2_factor"] = factor;
      params["epsilon_sigma"] = 100.0;  // phase 1 must not separate them
      return number_of_clusters(
          merge_lines({centred({3, 1}, direction), centred(Vec2(3, 1) + offset, direction)}, params).cluster2);
    };
    for (const double f : {1.0, 2.0}) {
      const double along_limit = 4.0 * kModeSigma * std::sqrt(f);
      const double across_limit = 0.2 * kModeSigma * std::sqrt(f);
      EXPECT_EQ(clusters_at(0.95 * along_limit * along, f), 1) << direction_deg;
      EXPECT_EQ(clusters_at(1.05 * along_limit * along, f), 2) << direction_deg;
      EXPECT_EQ(clusters_at(0.95 * across_limit * across, f), 1) << direction_deg;
      EXPECT_EQ(clusters_at(1.05 * across_limit * across, f), 2) << direction_deg;
    }
  }
}

TEST(MeanShift, ThePrintedKernelIsLongAlongTheMirroredDirection) {
  const double direction = radians(30.0);
  const Vec2 along(std::cos(direction), std::sin(direction));
  const Vec2 mirrored(std::cos(direction), -std::sin(direction));
  const auto clusters_at = [&](const Vec2& offset, const char* kernel) {
    ParamSet params = strict_and("kernel2", std::string(kernel));
    params["epsilon_sigma"] = 100.0;
    return number_of_clusters(
        merge_lines({centred({3, 1}, direction), centred(Vec2(3, 1) + offset, direction)}, params).cluster2);
  };
  EXPECT_EQ(clusters_at(0.6 * along, "rotated"), 1);
  EXPECT_EQ(clusters_at(0.6 * along, "printed"), 2);
  EXPECT_EQ(clusters_at(0.6 * mirrored, "rotated"), 2);
  EXPECT_EQ(clusters_at(0.6 * mirrored, "printed"), 1);
}

TEST(MeanShift, IdenticalSegmentsGiveOneEqualToThem) {
  const MapLine one = line(1.0, -2.0, 2.3, 0.4);
  for (const std::size_t n : {1U, 2U, 7U, 500U}) {
    const MergeResult r = merge_lines(std::vector<MapLine>(n, one));
    EXPECT_EQ(r.status, Status::converged);
    ASSERT_EQ(r.map.lines.size(), 1U);
    EXPECT_LT(apart(r.map.lines[0].segment, one.segment), 1e-9);
    EXPECT_EQ(r.map.lines[0].members, static_cast<int>(n));
    EXPECT_EQ(r.labels, std::vector<int>(n, 0));
  }
}

TEST(MeanShift, ASegmentOfAnyLengthAndDirectionGivesItself) {
  for (const double length : {1e-6, 0.05, 0.39, 0.4, 0.41, 1.0, 3.7, 40.0, 1000.0})
    for (const double direction_deg : {0.0, 45.0, 90.0, 137.0, 179.999999}) {
      const MapLine one = centred({12.0, -7.0}, radians(direction_deg), length);
      const MergeResult r = merge_lines({one});
      ASSERT_EQ(r.map.lines.size(), 1U) << length << " at " << direction_deg;
      EXPECT_LT(apart(r.map.lines[0].segment, one.segment), 1e-9) << length << " at " << direction_deg;
    }
}

TEST(MeanShift, TheOutputsOfOneSegmentCoverItForEveryLabelling) {
  const MapLine one = centred({2.0, 1.0}, 0.6, 7.3);
  for (const double epsilon : {0.01, 0.25, 1.0, 2.0, 10.0}) {
    const MergeResult r = merge_lines({one}, {{"epsilon_sigma", epsilon}, {"epsilon2", 0.5 * epsilon}});
    const Vec2 along = one.segment.direction();
    std::vector<std::pair<double, double>> intervals;
    for (const MapLine& l : r.map.lines) {
      EXPECT_LT(std::abs(cross(along, l.segment.a - one.segment.a)), 1e-9);
      EXPECT_LT(std::abs(cross(along, l.segment.b - one.segment.a)), 1e-9);
      intervals.push_back(
          std::minmax({along.dot(l.segment.a - one.segment.a), along.dot(l.segment.b - one.segment.a)}));
    }
    std::sort(intervals.begin(), intervals.end());
    double reached = 0.0;
    for (const auto& [from, to] : intervals) {
      EXPECT_NEAR(from, reached, 1e-9);
      reached = to;
    }
    EXPECT_NEAR(reached, 7.3, 1e-9);
  }
}

// Exact modes of a wall seen often are two to three sigma apart on a flat ridge, so distance alone does not link them.
TEST(MeanShift, AWallSeenOftenIsOneLineBecauseModesOfOneRidgeAreLinked) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    CounterRng rng(seed, RngStream::pose);
    std::vector<MapLine> lines;
    for (int scan = 0; scan < 20; ++scan) {
      const double from = rng.uniform();
      lines.push_back(centred({5.0 + from, 0.005 * rng.normal()}, radians(0.3 * rng.normal()), 10.0));
    }
    EXPECT_EQ(merge_lines(lines, {{"join", false}}).map.lines.size(), 1U);
    EXPECT_GT(merge_lines(lines, {{"join", false}, {"ridge_dip", 0.0}}).map.lines.size(), 4U);
  }
}

// A ridge that bends is not followed, so a round column stays a polygon.
TEST(MeanShift, ARoundColumnStaysRound) {
  for (const double radius : {0.5, 2.0}) {
    CounterRng rng(4, RngStream::pose);
    std::vector<MapLine> lines;
    for (int scan = 0; scan < 400 * radius; ++scan) {
      const double at = kTwoPi * rng.uniform();
      lines.push_back(centred(radius * Vec2(std::cos(at), std::sin(at)), at + kPi / 2, 0.2));
    }
    const MergeResult r = merge_lines(lines);
    EXPECT_GE(r.map.lines.size(), 6U);
    for (const MapLine& l : r.map.lines) {
      EXPECT_LT(l.segment.length(), 1.6) << radius;
      EXPECT_NEAR(l.segment.midpoint().norm(), radius, 0.1) << radius;
    }
  }
}

TEST(MeanShift, IsEquivariantUnderRigidMotions) {
  const auto lines = noisy_walls(1);
  const MergeResult plain = merge_lines(lines);
  for (const Pose2& motion : {Pose2(0.0, 0.0, kPi / 2), Pose2(13.1, -7.7, 0.4), Pose2(-2.0, 900.0, -2.2)}) {
    std::vector<MapLine> moved = lines;
    for (MapLine& l : moved) l.segment = motion * l.segment;
    const MergeResult r = merge_lines(moved);
    ASSERT_EQ(r.map.lines.size(), plain.map.lines.size());
    for (const MapLine& expected : plain.map.lines) {
      double nearest = kNoLimit;
      for (const MapLine& found : r.map.lines)
        nearest = std::min(nearest, apart(found.segment, motion * expected.segment));
      EXPECT_LT(nearest, 1e-6);
    }
  }
}

TEST(MeanShift, IsEquivariantUnderScalingWithSigma) {
  const auto lines = noisy_walls(2);
  const MergeResult plain = merge_lines(lines);
  for (const double scale : {1e-3, 7.0, 1000.0}) {
    std::vector<MapLine> scaled = lines;
    for (MapLine& l : scaled) l.segment = {scale * l.segment.a, scale * l.segment.b};
    const MergeResult r = merge_lines(scaled, {{"sigma_m", scale * kModeSigma}});
    ASSERT_EQ(r.map.lines.size(), plain.map.lines.size());
    for (std::size_t k = 0; k < plain.map.lines.size(); ++k) {
      const Segment& s = plain.map.lines[k].segment;
      EXPECT_LT(apart(r.map.lines[k].segment, {scale * s.a, scale * s.b}), 1e-6 * scale);
    }
    EXPECT_EQ(r.labels, plain.labels);
  }
}

TEST(MeanShift, DependsNeitherOnTheOrderNorOnTheSenseOfTheSegments) {
  const auto lines = noisy_walls(3);
  const MergeResult plain = merge_lines(lines);
  CounterRng rng(9, RngStream::pose);
  for (int round = 0; round < 3; ++round) {
    std::vector<std::size_t> order(lines.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[rng.bits() % i]);
    std::vector<MapLine> shuffled;
    for (const std::size_t i : order) {
      shuffled.push_back(lines[i]);
      if (rng.uniform() < 0.5) std::swap(shuffled.back().segment.a, shuffled.back().segment.b);
    }
    const MergeResult r = merge_lines(shuffled);
    ASSERT_EQ(r.map.lines.size(), plain.map.lines.size());
    for (std::size_t k = 0; k < r.map.lines.size(); ++k) {
      EXPECT_LT((r.map.lines[k].segment.a - plain.map.lines[k].segment.a).norm(), 1e-9);
      EXPECT_LT((r.map.lines[k].segment.b - plain.map.lines[k].segment.b).norm(), 1e-9);
      EXPECT_EQ(r.map.lines[k].members, plain.map.lines[k].members);
    }
    for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(r.labels[i], plain.labels[order[i]]);
  }
}

// With merge_gap 0 and nothing joined, the lines of a phase-2 cluster cover exactly what their members' projections
// cover.
TEST(MeanShift, ReachesAsFarAsTheProjectionsOfItsMembers) {
  for (const double gap : {0.0, 0.1}) {
    const std::vector<MapLine> lines{line(0, 0, 1, 0),
                                     line(0.8, 0.004, 1.5, 0.004),
                                     line(1.5, 0, 1.8, 0),
                                     line(1.2, 0.001, 1.25, 0.001),
                                     line(1.85, 0.002, 2.15, 0.002),
                                     line(5.0, 0, 5.5, 0)};
    const MergeResult r = merge_lines(lines, {{"merge_gap_m", gap}, {"join", false}});
    std::vector<std::pair<double, double>> found;
    for (const MapLine& l : r.map.lines) {
      EXPECT_NEAR(l.segment.a.y(), 0.0, 0.005);
      found.emplace_back(l.segment.a.x(), l.segment.b.x());
    }
    std::sort(found.begin(), found.end());
    const std::vector<std::pair<double, double>> expected =
        gap == 0.0 ? std::vector<std::pair<double, double>>{{0, 1.8}, {1.85, 2.15}, {5.0, 5.5}}
                   : std::vector<std::pair<double, double>>{{0, 2.15}, {5.0, 5.5}};
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_NEAR(found[k].first, expected[k].first, 1e-6);
      EXPECT_NEAR(found[k].second, expected[k].second, 1e-6);
    }
  }
}

TEST(MeanShift, CountsMembersAndSharesPointsByLength) {
  MapLine a = line(0, 0, 1, 0);
  a.members = 3;
  a.points = 30;
  MapLine b = line(0.5, 0, 1.5, 0);
  b.points = 12;
  const MergeResult r = merge_lines({a, b});
  ASSERT_EQ(r.map.lines.size(), 1U);
  EXPECT_EQ(r.map.lines[0].members, 4);
  EXPECT_EQ(r.map.lines[0].points, 42);
}

TEST(MeanShift, AcceleratedClimbsEndAtTheModesOfEquation1) {
  const auto lines = noisy_walls(5);
  const MergeResult fast = merge_lines(lines);
  const MergeResult plain = merge_lines(lines, {{"accelerate", false}, {"capture", false}});
  ASSERT_EQ(fast.map.lines.size(), plain.map.lines.size());
  EXPECT_EQ(fast.labels, plain.labels);
  for (std::size_t k = 0; k < plain.map.lines.size(); ++k)
    EXPECT_LT(apart(fast.map.lines[k].segment, plain.map.lines[k].segment), 1e-6);
}

TEST(MeanShift, InOnePhaseMergesSimpleDataAlike) {
  const ParamSet single{{"phases", std::string("single")}};
  const MapLine wall = centred({1.0, 2.0}, 0.9, 3.0);
  const MergeResult one = merge_lines(std::vector<MapLine>(9, wall), single);
  ASSERT_EQ(one.map.lines.size(), 1U);
  EXPECT_LT(apart(one.map.lines[0].segment, wall.segment), 1e-9);
  // Parallel walls nearer than sigma but farther than sigma_y stay apart, crossing ones too.
  EXPECT_EQ(merge_lines({line(0, 0, 0.4, 0), line(0, 0.1, 0.4, 0.1)}, single).map.lines.size(), 2U);
  EXPECT_EQ(merge_lines({line(-0.2, 0, 0.2, 0), line(0, -0.2, 0, 0.2)}, single).map.lines.size(), 2U);
  EXPECT_EQ(merge_lines({line(0, 0, 0.4, 0), line(0.3, 0.01, 0.7, 0.01)}, single).map.lines.size(), 1U);
}

}  // namespace
}  // namespace scanbench
