// Polylines of greatest likelihood: the search against all chains of a few points, the refinement against numerical
// derivatives, and the results of both on scans of polygons.
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "algorithms/extract/parts/beam_line.hpp"
#include "algorithms/extract/polyline/chain.hpp"
#include "algorithms/extract/polyline/search.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"
#include "core/rng.hpp"

namespace scanbench::extract {
namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();

// Range from the origin to a closed polygon around it.
double range_to(const std::vector<Vec2>& polygon, const Vec2& d) {
  double best = kNothing;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], along = polygon[(i + 1) % polygon.size()] - a;
    const double det = cross(d, along);
    const double t = cross(a, along) / det, s = cross(a, d) / det;
    if (t > 0 && s >= 0 && s <= 1) best = std::min(best, t);
  }
  return best;
}

const std::vector<Vec2> kPentagon = {{3.1, 0.4}, {1.2, 2.7}, {-2.3, 2.2}, {-2.9, -1.4}, {0.8, -3.0}};

SensorModel all_around(int beams, double sigma, double sign = 1.0) {
  SensorModel s;
  s.geometry = ScanGeometry(-sign * kPi, sign * kTwoPi / beams, beams);
  s.noise.sigma_m = sigma;
  return s;
}

std::vector<double> scan_of(const std::vector<Vec2>& polygon, const SensorModel& s, std::uint32_t seed) {
  std::vector<double> ranges;
  for (int i = 0; i < s.geometry.beams(); ++i) {
    CounterRng rng(seed, RngStream::range, 0, static_cast<std::uint32_t>(i));
    ranges.push_back(range_to(polygon, s.geometry.direction(i)) + s.noise.sigma_m * rng.normal());
  }
  return ranges;
}

ScanLines polyline(const SensorModel& s, const std::vector<double>& ranges, std::int64_t vertices) {
  Trace silent;
  return Registry<LineExtractor>::make("polyline", {{"vertices", vertices}})->extract({s, ranges}, silent);
}

// ---- the search

std::vector<SegmentationPoint> few_points(std::uint32_t seed, int n) {
  CounterRng rng(seed, RngStream::pose);
  std::vector<SegmentationPoint> points;
  for (int i = 0; i < n; ++i)
    points.push_back({.direction = {std::cos(0.2 * i), std::sin(0.2 * i)},
                      .inverse_range = 0.4 + 0.2 * rng.uniform(),
                      .weight = 100 + 2000 * rng.uniform(),
                      .line_cost = -rng.uniform(),
                      .clutter_cost = 4 * rng.uniform(),
                      .gap_cost = rng.uniform() < 0.15 ? (rng.uniform() < 0.5 ? 1.0 : kNothing) : 0.0});
  return points;
}

VertexChoices few_choices(const std::vector<SegmentationPoint>& points, std::uint32_t seed) {
  CounterRng rng(seed, RngStream::resampling);
  VertexChoices choices;
  for (const SegmentationPoint& p : points)
    choices.push_back({p.inverse_range, p.inverse_range + 0.1 * (rng.uniform() - 0.5)});
  return choices;
}

double own_cost(const SegmentationPoint& p, double u) {
  return p.line_cost + 0.5 * p.weight * std::pow(p.inverse_range - u, 2);
}

// Points behind the vertex (i, u) up to the vertex (j, v), by the line through the two places.
double wall_cost(const std::vector<SegmentationPoint>& points, int i, double u, int j, double v) {
  const auto& p = points[static_cast<std::size_t>(i)];
  const auto& q = points[static_cast<std::size_t>(j)];
  Eigen::Matrix2d rows;
  rows << p.direction.transpose(), q.direction.transpose();
  const Vec2 theta = rows.inverse() * Vec2(u, v);
  double cost = j == i + 1 ? kBareWall : 0.0;
  for (int k = i + 1; k <= j; ++k) {
    const auto& z = points[static_cast<std::size_t>(k)];
    cost += own_cost(z, theta.dot(z.direction)) + z.gap_cost;
  }
  return cost;
}

// The least cost from point i on, by trying everything; `open`: a chain is open with its last vertex at (i, u), point i
// paid for.
double rest(const std::vector<SegmentationPoint>& points, const VertexChoices& choices, int i, int left, double charge,
            double u, bool open, bool may_end) {
  const int n = static_cast<int>(points.size());
  double best = kNothing;
  if (open) {
    if (may_end) best = rest(points, choices, i + 1, left, charge, 0, false, false);
    if (left > 0)
      for (int j = i + 1; j < n; ++j)
        for (const double v : choices[static_cast<std::size_t>(j)]) {
          const double wall = wall_cost(points, i, u, j, v);
          if (wall < kNothing)
            best = std::min(best, wall + charge + rest(points, choices, j, left - 1, charge, v, true, true));
        }
    return best;
  }
  if (i == n) return 0.0;
  const auto& p = points[static_cast<std::size_t>(i)];
  best = p.clutter_cost + rest(points, choices, i + 1, left, charge, 0, false, false);
  if (left > 0)
    for (const double v : choices[static_cast<std::size_t>(i)])
      best = std::min(best, own_cost(p, v) + charge + rest(points, choices, i, left - 1, charge, v, true, false));
  return best;
}

double cost_of(const std::vector<SegmentationPoint>& points, const GridChains& found, double charge) {
  double cost = 0.0;
  std::vector<bool> explained(points.size(), false);
  for (const auto& chain : found.chains) {
    cost += own_cost(points[static_cast<std::size_t>(chain[0].point)], chain[0].inverse_range) + charge;
    for (std::size_t k = 0; k + 1 < chain.size(); ++k)
      cost += charge +
              wall_cost(points, chain[k].point, chain[k].inverse_range, chain[k + 1].point, chain[k + 1].inverse_range);
    for (int i = chain.front().point; i <= chain.back().point; ++i) explained[static_cast<std::size_t>(i)] = true;
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!explained[i]) cost += points[i].clutter_cost;
  return cost;
}

TEST(PolylineSearch, CostsAsLittleAsTheBestOfAllChainsOfAFewPoints) {
  for (std::uint32_t seed = 0; seed < 40; ++seed)
    for (const int vertices : {0, 2, 3, 5})
      for (const double charge : {0.0, 1.5}) {
        const auto points = few_points(seed, 2 + static_cast<int>(seed % 5));
        const auto choices = few_choices(points, seed);
        const GridChains found = best_chains(points, choices, vertices, charge, 1);
        const double best = rest(points, choices, 0, vertices, charge, 0, false, false);
        std::size_t used = 0;
        for (const auto& chain : found.chains) used += chain.size();
        EXPECT_LE(used, static_cast<std::size_t>(vertices));
        EXPECT_NEAR(cost_of(points, found, charge), best, 1e-6) << "seed " << seed << ", " << vertices;
        EXPECT_NEAR(found.cost + charge * static_cast<double>(used), best, 1e-6);
      }
}

TEST(PolylineSearch, TheClosedChainIsTheBestOfAllWithItsVertex) {
  // Six beams all around and four vertices, one of them given: all choices of the other three.
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    auto points = few_points(seed, 6);
    for (std::size_t i = 0; i < 6; ++i) {
      const double a = static_cast<double>(i) * kTwoPi / 6;
      points[i].direction = {std::cos(a), std::sin(a)};
      points[i].gap_cost = 0.0;
    }
    const auto choices = few_choices(points, seed);
    const GridVertex fixed{2, choices[2][1]};
    auto turned = points;  // from the fixed vertex to itself
    std::rotate(turned.begin(), turned.begin() + 2, turned.end());
    turned.push_back(turned.front());
    turned.back().weight = 0.0;
    turned.back().line_cost = 0.0;
    double best = kNothing;
    for (int i = 1; i < 6; ++i)
      for (int j = i + 1; j < 6; ++j)
        for (int k = j + 1; k < 6; ++k) {
          const std::array<int, 5> at = {0, i, j, k, 6};
          if (at[1] - at[0] > 2 || at[2] - at[1] > 2 || at[3] - at[2] > 2 || at[4] - at[3] > 2)
            continue;  // half a turn
          for (int c = 0; c < 8; ++c) {
            const auto u = [&](int m) {
              if (m == 0 || m == 4) return fixed.inverse_range;
              return choices[static_cast<std::size_t>((at[static_cast<std::size_t>(m)] + 2) % 6)]
                            [static_cast<std::size_t>(c >> (m - 1) & 1)];
            };
            double cost = own_cost(turned[0], fixed.inverse_range);
            for (int m = 0; m < 4; ++m)
              cost += wall_cost(turned, at[static_cast<std::size_t>(m)], u(m), at[static_cast<std::size_t>(m) + 1],
                                u(m + 1));
            best = std::min(best, cost);
          }
        }
    const GridChains found = best_closed_chain(points, choices, 4, 1, fixed);
    ASSERT_EQ(found.chains.size(), 1u);
    EXPECT_EQ(found.chains[0].size(), 5u);
    EXPECT_NEAR(found.cost, best, 1e-6) << "seed " << seed;
  }
}

// ---- the refinement

TEST(PolylineChain, NoNeighbourIsMoreLikely) {
  const SensorModel s = all_around(180, 0.03);
  for (std::uint32_t seed = 0; seed < 5; ++seed) {
    const std::vector<double> ranges = scan_of(kPentagon, s, seed);
    std::vector<BearingReading> readings;
    for (int i = 0; i < 180; ++i) readings.push_back({s.geometry.angle(i), ranges[static_cast<std::size_t>(i)], 0.03});
    Chain start{.vertices = {}, .closed = true};
    for (const Vec2& v : {kPentagon[3], kPentagon[4], kPentagon[0], kPentagon[1], kPentagon[2]})
      start.vertices.push_back({std::atan2(v.y(), v.x()) + 0.03, 1 / (v.norm() + 0.1)});
    const ChainFit fit = fit_chain(start, readings);
    EXPECT_LT(fit.half_squares, 0.5 * (180 + 5 * std::sqrt(360.0)));  // chi-square of the readings
    for (std::size_t k = 0; k < 5; ++k)
      for (const double h : {1e-4, -1e-4}) {
        Chain moved = fit.chain;
        moved.vertices[k].inverse_range += h;
        EXPECT_GT(half_squares(moved, readings), fit.half_squares);
        moved = fit.chain;
        moved.vertices[k].bearing_rad += h;
        EXPECT_GT(half_squares(moved, readings), fit.half_squares);
      }
  }
}

TEST(PolylineChain, ErrorsAreAsLargeAsItsCovarianceSays) {
  const SensorModel s = all_around(180, 0.01);
  const int trials = 300;
  double sum = 0;
  for (std::uint32_t seed = 0; seed < trials; ++seed) {
    const std::vector<double> ranges = scan_of(kPentagon, s, seed);
    std::vector<BearingReading> readings;
    for (int i = 0; i < 180; ++i) readings.push_back({s.geometry.angle(i), ranges[static_cast<std::size_t>(i)], 0.01});
    Chain truth{.vertices = {}, .closed = true};
    for (const Vec2& v : {kPentagon[3], kPentagon[4], kPentagon[0], kPentagon[1], kPentagon[2]})
      truth.vertices.push_back({std::atan2(v.y(), v.x()), 1 / v.norm()});
    const ChainFit fit = fit_chain(truth, readings);
    Eigen::VectorXd e(10);
    for (std::size_t k = 0; k < 5; ++k) {
      const auto i = static_cast<Eigen::Index>(2 * k);
      e[i] = fit.chain.vertices[k].bearing_rad - truth.vertices[k].bearing_rad;
      e[i + 1] = fit.chain.vertices[k].inverse_range - truth.vertices[k].inverse_range;
    }
    sum += e.dot(fit.covariance.ldlt().solve(e));
  }
  // Chi-square of 10 degrees of freedom a trial. Readings at corners may change walls, hence the wider band.
  EXPECT_NEAR(sum / trials, 10.0, 4 * std::sqrt(20.0 / trials));
}

// ---- the module

TEST(PolylineModule, RecoversAPolygonWithoutNoise) {
  for (const double sign : {1.0, -1.0}) {
    const SensorModel s = all_around(360, 0.0, sign);
    const ScanLines out = polyline(s, scan_of(kPentagon, s, 1), 5);
    ASSERT_EQ(out.lines.size(), 5u) << sign;
    for (const LineFeature& line : out.lines) {
      double nearest_a = kNothing, nearest_b = kNothing;
      for (const Vec2& v : kPentagon) {
        nearest_a = std::min(nearest_a, (line.segment.a - v).norm());
        nearest_b = std::min(nearest_b, (line.segment.b - v).norm());
      }
      EXPECT_LT(nearest_a, 1e-6);
      EXPECT_LT(nearest_b, 1e-6);
      EXPECT_GT(cross(line.segment.a, line.segment.b), 0.0);  // the sensor on its left
    }
    for (const int label : out.labels) EXPECT_GE(label, 0);
  }
}

TEST(PolylineModule, FindsHowManyVerticesThereAre) {
  for (std::uint32_t seed = 0; seed < 5; ++seed) {
    const SensorModel s = all_around(360, 0.02);
    EXPECT_EQ(polyline(s, scan_of(kPentagon, s, seed), 0).lines.size(), 5u);
  }
}

TEST(PolylineModule, GivesAtMostAsManyVerticesAsRequested) {
  SensorModel s = all_around(360, 0.02);
  s.geometry = ScanGeometry(-2.0, 0.01, 400);  // not closed
  const std::vector<double> ranges = scan_of(kPentagon, s, 1);
  for (const std::int64_t v : {2, 3, 5, 9}) {
    const ScanLines out = polyline(s, ranges, v);
    EXPECT_LT(out.lines.size(), static_cast<std::size_t>(v));
    EXPECT_GE(out.lines.size(), 1u);
  }
}

TEST(PolylineModule, OneWallIsTheLineOfGreatestLikelihood) {
  SensorModel s;
  s.geometry = ScanGeometry(-0.4, 0.02, 50);
  s.noise.sigma_m = 0.02;
  std::vector<double> ranges;
  std::vector<BeamReading> readings;
  for (int i = 0; i < 50; ++i) {
    CounterRng rng(7, RngStream::range, 0, static_cast<std::uint32_t>(i));
    ranges.push_back(2.0 / std::cos(s.geometry.angle(i) - 0.3) + 0.02 * rng.normal());
    readings.push_back({s.geometry.direction(i), ranges.back()});
  }
  const ScanLines out = polyline(s, ranges, 2);
  const auto line = fit_beam_line(readings, s.noise);
  ASSERT_EQ(out.lines.size(), 1u);
  ASSERT_TRUE(line);
  EXPECT_NEAR(out.lines[0].line.rho, line->rho(), 1e-6);
  EXPECT_NEAR(out.lines[0].line.alpha, std::atan2(line->theta.y(), line->theta.x()), 1e-6);
  const Eigen::Matrix2d expected = line_covariance(*line, out.lines[0].segment.midpoint());
  ASSERT_TRUE(out.lines[0].covariance);
  EXPECT_LT((*out.lines[0].covariance - expected).norm(), 1e-4 * expected.norm());
}

}  // namespace
}  // namespace scanbench::extract
