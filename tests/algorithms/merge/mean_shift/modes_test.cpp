// Non-blurring Gaussian mean shift against a brute force in double written here.
#include "algorithms/merge/mean_shift/modes.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include <cmath>
#include <vector>

#include "algorithms/merge/mean_shift/kernel_sum.hpp"
#include "algorithms/merge/mean_shift/sum_kernels.hpp"
#include "core/rng.hpp"

namespace scanbench::merge {
namespace {

constexpr double kPeriod = 18.0;  // that of directions with the default bandwidth

double circular(double d, double period) {
  return period > 0 ? std::remainder(d, period) : d;
}

Vec3 difference(const Vec3& a, const Vec3& b, double period) {
  Vec3 d = a - b;
  d.z() = circular(d.z(), period);
  return d;
}

/// Eq. 1 over all points, nothing cut off.
Vec3 full_shift(const std::vector<Vec3>& points, const Vec3& t, double period) {
  Vec3 sum = Vec3::Zero();
  double mass = 0;
  for (const Vec3& p : points) {
    const Vec3 d = difference(p, t, period);
    const double w = std::exp(-0.5 * d.squaredNorm());
    sum += w * d;
    mass += w;
  }
  return sum / mass;
}

double full_density(const std::vector<Vec3>& points, const Vec3& t, double period) {
  double mass = 0;
  for (const Vec3& p : points) mass += std::exp(-0.5 * difference(p, t, period).squaredNorm());
  return mass;
}

Vec3 brute_force_mode(const std::vector<Vec3>& points, Vec3 t, double period) {
  for (int k = 0; k < 100000; ++k) {
    const Vec3 s = full_shift(points, t, period);
    t += s;
    if (s.norm() < 1e-11) break;
  }
  return t;
}

/// Blobs of standard deviation 0.35 with centres uniform in a box, like pieces of walls in many scans.
std::vector<Vec3> blobs(std::uint64_t seed, int centres, int per_centre, double side, double period) {
  CounterRng rng(seed, RngStream::resampling);
  std::vector<Vec3> points;
  for (int c = 0; c < centres; ++c) {
    const Vec3 centre(side * rng.uniform(), side * rng.uniform(), (period > 0 ? period : side) * rng.uniform());
    for (int k = 0; k < per_centre; ++k) {
      Vec3 p = centre + 0.35 * Vec3(rng.normal(), rng.normal(), rng.normal());
      if (period > 0) p.z() -= period * std::floor(p.z() / period);
      points.push_back(p);
    }
  }
  return points;
}

std::vector<const SumKernels*> all_kernels() {
  std::vector<const SumKernels*> kernels{&baseline::kSumKernels};
  if (best_isa() == Isa::v3) kernels.push_back(&v3::kSumKernels);
  return kernels;
}

TEST(GaussianLanes, AgreeWithTheExponentialFunction) {
  for (float s = 0.0F; s <= 160.0F; s += 0.0371F) {
    const double expected = std::exp(-0.5 * static_cast<double>(s));
    const std::vector<float> squared(kSumLanes, s);
    for (const SumKernels* kernels : all_kernels()) {
      std::vector<float> g(kSumLanes);
      kernels->gaussian(squared.data(), g.data());
      for (const float v : g) EXPECT_NEAR(static_cast<double>(v) / expected, 1.0, 8e-6) << s;
    }
  }
}

TEST(CandidateList, HasTheSameBytesOnEveryProcessor) {
  if (best_isa() == Isa::baseline) GTEST_SKIP() << "this processor has one set of kernels";
  const auto points = blobs(5, 20, 40, 12.0, kPeriod);
  const PointGrid grid(points, 1.0, kPeriod);
  CandidateList one(Isa::baseline), other(Isa::v3);
  CounterRng rng(4, RngStream::resampling);
  for (int k = 0; k < 200; ++k) {
    const Vec3 centre(12 * rng.uniform(), 12 * rng.uniform(), kPeriod * rng.uniform());
    for (CandidateList* list : {&one, &other}) {
      list->clear();
      list->add_near(grid, centre, {0.5, 0.5, 0.6}, 4.0);
      list->seal();
    }
    const Float3 t = Float3::rounded({rng.uniform() - 0.5, rng.uniform() - 0.5, rng.uniform() - 0.5});
    const ShiftAndCovariance a = one.shift_and_covariance(t, 16.0F), b = other.shift_and_covariance(t, 16.0F);
    EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);
    const Shift c = one.shift(t, 16.0F), d = other.shift(t, 16.0F);
    EXPECT_EQ(std::memcmp(&c, &d, sizeof c), 0);
  }
}

TEST(CandidateList, HasThePointsNearABox) {
  const auto points = blobs(6, 20, 40, 12.0, kPeriod);
  const PointGrid grid(points, 1.0, kPeriod);
  CounterRng rng(9, RngStream::resampling);
  const Vec3 half(0.5, 0.4, 0.6);
  for (int k = 0; k < 200; ++k) {
    const Vec3 centre(14 * rng.uniform() - 1, 14 * rng.uniform() - 1, kPeriod * rng.uniform());
    CandidateList near, expected;
    near.add_near(grid, centre, half, 2.0);
    near.seal();
    for (const Vec3& p : points) {
      Vec3 d = p - centre;
      d.z() -= kPeriod * std::round(d.z() / kPeriod);
      if ((d.cwiseAbs() - half).cwiseMax(0.0).norm() <= 2.0) expected.add(Float3::rounded(d));
    }
    expected.seal();
    // Sums over the same points in another order.
    const Shift a = near.shift({}, 16.0F), b = expected.shift({}, 16.0F);
    EXPECT_NEAR(a.mass, b.mass, 1e-5F * b.mass);
    EXPECT_NEAR(a.step.x, b.step.x, 1e-5F);
    EXPECT_NEAR(a.step.z, b.step.z, 1e-5F);
  }
}

TEST(CandidateList, SumsWhatTheDefinitionSums) {
  CounterRng rng(3, RngStream::resampling);
  CandidateList list;
  std::vector<Vec3> points;
  for (int k = 0; k < 101; ++k) {  // no multiple of eight
    const Vec3 p(2 * rng.normal(), 2 * rng.normal(), 2 * rng.normal());
    points.push_back(p);
    list.add({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
  }
  list.seal();
  const Vec3 t(0.3, -0.2, 0.1);
  double mass = 0;
  Vec3 sum = Vec3::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (const Vec3& p : points) {
    const Vec3 d = p - t;
    if (d.norm() > 3.0) continue;
    const double w = std::exp(-0.5 * d.squaredNorm());
    mass += w;
    sum += w * d;
    second += w * d * d.transpose();
  }
  const Vec3 m = sum / mass;
  const Eigen::Matrix3d covariance = second / mass - m * m.transpose();
  const auto s = list.shift_and_covariance({0.3F, -0.2F, 0.1F}, 9.0F);
  EXPECT_NEAR(s.shift.mass, mass, 1e-5 * mass);
  EXPECT_NEAR(s.shift.step.x, m.x(), 1e-5);
  EXPECT_NEAR(s.shift.step.y, m.y(), 1e-5);
  EXPECT_NEAR(s.shift.step.z, m.z(), 1e-5);
  EXPECT_NEAR(s.xx, covariance(0, 0), 2e-5);
  EXPECT_NEAR(s.yz, covariance(1, 2), 2e-5);
  EXPECT_NEAR(s.xz, covariance(0, 2), 2e-5);
  EXPECT_EQ(list.shift({0.3F, -0.2F, 0.1F}, 9.0F).mass, s.shift.mass);
  EXPECT_EQ(list.shift({100.0F, 0.0F, 0.0F}, 9.0F).mass, 0.0F);
}

TEST(MeanShiftModes, HaveAGradientOfZeroInTheUntruncatedDensity) {
  for (const double period : {0.0, kPeriod}) {
    const auto points = blobs(7, 25, 40, 20.0, period);
    const Modes modes = find_modes(points, {.period = period});
    EXPECT_TRUE(modes.converged);
    for (const Vec3& m : modes.positions) EXPECT_LT(full_shift(points, m, period).norm(), 1e-6);
  }
}

// The kernel is cut at 4 standard deviations while climbing only. The cut has an effect only for starts on a watershed.
TEST(MeanShiftModes, AreWhereBruteForceEndsUpToStartsOnAWatershed) {
  int other = 0;
  int all = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto points = blobs(seed, 12, 16, 12.0, kPeriod);
    const Modes modes = find_modes(points, {.period = kPeriod});
    for (std::size_t i = 0; i < points.size(); i += 2) {
      const Vec3 expected = brute_force_mode(points, points[i], kPeriod);
      const Vec3 found = modes.positions[static_cast<std::size_t>(modes.mode_of[i])];
      ++all;
      if (difference(expected, found, kPeriod).norm() > 1e-5) ++other;
    }
  }
  EXPECT_EQ(all, 288);
  EXPECT_LE(other, 1);
}

TEST(MeanShiftModes, DoNotMoveWhenClimbsAreCapturedByKnownModes) {
  for (std::uint64_t seed = 11; seed <= 15; ++seed) {
    const auto points = blobs(seed, 40, 25, 20.0, kPeriod);
    const Modes with = find_modes(points, {.period = kPeriod, .capture = true});
    const Modes without = find_modes(points, {.period = kPeriod, .capture = false});
    ASSERT_EQ(with.positions.size(), without.positions.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3 d = difference(with.positions[static_cast<std::size_t>(with.mode_of[i])],
                                without.positions[static_cast<std::size_t>(without.mode_of[i])], kPeriod);
      EXPECT_LT(d.norm(), 1e-7) << seed << " point " << i;
    }
  }
}

// Cheng 1995: no step of mean shift descends. The climb under the truncated Gaussian ascends the density whose kernel
// is exp(-d^2/2) - exp(-c^2/2) inside the cut-off c; the last step, to the polished mode, ascends the full density.
TEST(MeanShiftModes, AreReachedAlongTrajectoriesOnWhichTheDensityNeverFalls) {
  constexpr double kCutoff = 4.0;
  const auto points = blobs(21, 12, 15, 11.0, kPeriod);
  const auto truncated_density = [&](const Vec3& t) {
    double sum = 0;
    for (const Vec3& p : points) {
      const double squared = difference(p, t, kPeriod).squaredNorm();
      if (squared < kCutoff * kCutoff) sum += std::exp(-0.5 * squared) - std::exp(-0.5 * kCutoff * kCutoff);
    }
    return sum;
  };
  std::vector<std::vector<Vec3>> paths;
  const Modes modes = find_modes(points, {.cutoff = kCutoff, .period = kPeriod, .capture = false}, &paths);
  ASSERT_EQ(paths.size(), points.size());
  std::size_t steps = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& path = paths[i];
    ASSERT_GE(path.size(), 2U);
    EXPECT_EQ(path.front(), points[i]);
    EXPECT_EQ(path.back(), modes.positions[static_cast<std::size_t>(modes.mode_of[i])]);
    for (std::size_t k = 1; k + 1 < path.size(); ++k, ++steps)
      EXPECT_GE(truncated_density(path[k]), truncated_density(path[k - 1]) * (1 - 1e-6)) << i << " step " << k;
    EXPECT_GE(full_density(points, path.back(), kPeriod),
              full_density(points, path[path.size() - 2], kPeriod) * (1 - 1e-4));
  }
  EXPECT_GT(steps, 3 * points.size());
}

// Two equal Gaussians have one mode if they are at most two standard deviations apart, else two at the roots of
// x = a tanh(a x), a half their distance.
TEST(MeanShiftModes, OfTwoPointsAreOneOrTwoAsTheirDistanceDemands) {
  for (const int axis : {0, 1, 2}) {
    for (const double distance : {0.5, 1.9, 1.99, 2.01, 2.1, 3.0, 5.0}) {
      const Vec3 step = Vec3::Unit(axis);
      const Vec3 middle(5.2, -3.1, 9.0);
      const std::vector<Vec3> points{middle - 0.5 * distance * step, middle + 0.5 * distance * step};
      const Modes modes = find_modes(points, {.period = kPeriod});
      const double a = 0.5 * distance;
      double x = a;
      for (int k = 0; k < 100000; ++k) x = a * std::tanh(a * x);
      if (a <= 1) x = 0;
      ASSERT_EQ(modes.positions.size(), distance <= 2 ? 1U : 2U) << distance;
      for (std::size_t i = 0; i < 2; ++i) {
        const Vec3 expected = middle + (i == 0 ? -x : x) * step;
        EXPECT_LT((modes.positions[static_cast<std::size_t>(modes.mode_of[i])] - expected).norm(), 1e-4) << distance;
      }
    }
  }
}

TEST(MeanShiftModes, AcrossTheSeamOfThePeriodicCoordinateAreAsElsewhere) {
  const std::vector<Vec3> near{{0, 0, 17.4}, {0, 0, 0.6}};
  const Modes one = find_modes(near, {.period = kPeriod});
  ASSERT_EQ(one.positions.size(), 1U);
  EXPECT_NEAR(circular(one.positions[0].z(), kPeriod), 0.0, 1e-6);
  const std::vector<Vec3> far{{0, 0, 16.9}, {0, 0, 1.1}};
  EXPECT_EQ(find_modes(far, {.period = kPeriod}).positions.size(), 2U);
}

// A row of equal Gaussians has a small mode at every member; its ends move inwards.
TEST(MeanShiftModes, OfARowAreOnePerMemberEvenOnTheFlattestRidge) {
  for (const double spacing : {1.7, 2.0}) {
    std::vector<Vec3> row;
    for (int k = 0; k < 41; ++k) row.emplace_back(spacing * k, 0.0, 0.0);
    const Modes modes = find_modes(row, {});
    EXPECT_TRUE(modes.converged);
    for (std::size_t k = 12; k <= 28; ++k) {
      const Vec3 m = modes.positions[static_cast<std::size_t>(modes.mode_of[k])];
      EXPECT_LT((m - row[k]).norm(), 0.05) << spacing;
      EXPECT_LT(full_shift(row, m, 0.0).norm(), 1e-6);
    }
  }
}

// The middle of a symmetric pair is a saddle of the density; the one point that starts there must not stay.
TEST(MeanShiftModes, AreNeverSaddles) {
  std::vector<Vec3> points{{0, 0, 0}};
  for (int k = 0; k < 40; ++k) {
    points.emplace_back(1.6, 0.0, 0.0);
    points.emplace_back(-1.6, 0.0, 0.0);
  }
  const Modes modes = find_modes(points, {});
  ASSERT_EQ(modes.positions.size(), 2U);
  for (const Vec3& m : modes.positions) EXPECT_GT(std::abs(m.x()), 1.0);
}

TEST(MeanShiftModes, AreTheSameForEveryOrderOfASortedSetAndForNoPoints) {
  EXPECT_TRUE(find_modes({}, {}).positions.empty());
  const std::vector<Vec3> same(1000, Vec3(1e6, -1e6, 3.0));
  const Modes one = find_modes(same, {.period = kPeriod});
  ASSERT_EQ(one.positions.size(), 1U);
  EXPECT_LT((one.positions[0] - same[0]).norm(), 1e-9);
}

}  // namespace
}  // namespace scanbench::merge
