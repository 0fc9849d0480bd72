// Forces and steps of force field simulation: what equations 1 and 2 of Lakaemper 2010 and mechanics say.
#include <gtest/gtest.h>

#include <cmath>

#include "algorithms/align/ffs/body.hpp"
#include "algorithms/align/ffs/force_field.hpp"
#include "algorithms/align/ffs/rigid_step.hpp"
#include "core/isa.hpp"
#include "core/rng.hpp"
#include "tests/support/plain_forces.hpp"

namespace scanbench {
namespace {

using namespace align::ffs;

FieldPoints random_points(int bodies, int each, double extent, std::uint64_t seed) {
  CounterRng rng(seed, RngStream::pose);
  FieldPoints points;
  for (int b = 0; b < bodies; ++b)
    for (int k = 0; k < each; ++k) {
      const double angle = kPi * rng.uniform();
      points.add({extent * rng.uniform(), extent * rng.uniform()}, {std::cos(angle), std::sin(angle)},
                 0.5 + rng.uniform(), b);
    }
  return points;
}

double norm_of(const std::vector<Vec2>& forces) {
  double sum = 0.0;
  for (const Vec2& f : forces) sum += f.squaredNorm();
  return std::sqrt(sum);
}

TEST(ForceField, IsMinusTheGradientOfThePotential) {
  const double sigma = 0.4;
  FieldPoints points = random_points(3, 12, 2.0, 1);
  const std::vector<Vec2> forces = support::plain_forces(points, sigma, 0.05 * sigma);
  const double h = 1e-5;
  for (std::size_t k = 0; k < points.size(); ++k)
    for (int axis = 0; axis < 2; ++axis) {
      const double at = points.at[k][axis];
      points.at[k][axis] = at + h;
      const double above = potential(points, {sigma, 10.0});
      points.at[k][axis] = at - h;
      const double below = potential(points, {sigma, 10.0});
      points.at[k][axis] = at;
      EXPECT_NEAR(forces[k][axis], -(above - below) / (2 * h), 1e-6 * norm_of(forces));
    }
}

TEST(ForceField, OfTwoPointsIsWhatTheEquationsSay) {
  FieldPoints points;
  const double turn = radians(25), sigma = 0.7, d = 0.5;
  points.add({1, 2}, {1, 0}, 1.0, 0);
  points.add({1, 2 + d}, {std::cos(turn), std::sin(turn)}, 2.5, 1);
  std::vector<PointForce> forces;
  point_forces(points, {sigma, 4.0}, forces);
  const double m = 2.5 * std::cos(turn) * std::exp(-d * d / (2 * sigma * sigma)) / (sigma * std::sqrt(kTwoPi));
  EXPECT_NEAR(forces[0].force.y(), m, 1e-5 * m) << "attraction";
  EXPECT_NEAR(forces[1].force.y(), -m, 1e-5 * m);
  EXPECT_NEAR(forces[0].force.x(), 0.0, 1e-5 * m);
  EXPECT_NEAR(forces[0].stiffness, m / d, 1e-5 * m / d);
}

TEST(ForceField, ThroughTheIndexIsThatOfThePlainLoopWithinTheStatedCut) {
  for (const double sigma : {0.05, 0.1, 0.5, 3.0})
    for (const double extent : {1.0, 6.0}) {
      const FieldPoints points = random_points(7, 60, extent, 9);
      std::vector<PointForce> forces;
      point_forces(points, {sigma, 4.0}, forces);
      const std::vector<Vec2> exact = support::plain_forces(points, sigma, 0.05 * sigma);
      std::vector<Vec2> error;
      for (std::size_t k = 0; k < points.size(); ++k) error.emplace_back(forces[k].force - exact[k]);
      // Every pair beyond the cut leaves out at most exp(-8) of the peak of the heaviest pair.
      const double weight = 1.5 * 1.5 * static_cast<double>(points.size());
      const double each = weight * std::exp(-8.0) / (sigma * std::sqrt(kTwoPi));
      EXPECT_LE(norm_of(error), each * std::sqrt(double(points.size())) + 1e-4 * norm_of(exact))
          << sigma << " " << extent;
      EXPECT_LE(norm_of(error), 0.01 * norm_of(exact) + 1e-12) << sigma << " " << extent;
    }
}

TEST(ForceField, WithoutSofteningIsThatOfTheEquationsAsTheyStand) {
  const FieldPoints points = random_points(6, 60, 3.0, 5);
  std::vector<PointForce> forces;
  point_forces(points, {0.3, 6.0, 1e-6}, forces);
  const std::vector<Vec2> exact = support::plain_forces(points, 0.3);
  std::vector<Vec2> error;
  for (std::size_t k = 0; k < points.size(); ++k) error.emplace_back(forces[k].force - exact[k]);
  EXPECT_LE(norm_of(error), 1e-4 * norm_of(exact));
}

TEST(ForceField, PotentialThroughTheIndexIsThatOfThePlainLoop) {
  const FieldPoints points = random_points(4, 50, 3.0, 4);
  const double exact = support::plain_potential(points, 0.3);
  EXPECT_NEAR(potential(points, {0.3, 6.0, 1e-6}), exact, 1e-7 * std::abs(exact));
  EXPECT_LT(exact, 0.0);
}

TEST(ForceField, HasTheSameBytesOnEveryProcessor) {
  if (best_isa() == Isa::baseline) GTEST_SKIP() << "this processor has one set of kernels";
  for (const double sigma : {0.05, 0.3, 3.0}) {
    const FieldPoints points = random_points(7, 60, 3.0, 11);
    std::vector<PointForce> one, other;
    point_forces(points, {sigma, 4.0}, one, Isa::baseline);
    point_forces(points, {sigma, 4.0}, other, Isa::v3);
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t k = 0; k < one.size(); ++k) {
      EXPECT_EQ(one[k].force, other[k].force);
      EXPECT_EQ(one[k].stiffness, other[k].stiffness);
    }
  }
}

TEST(ForceField, HasNoMomentum) {
  const FieldPoints points = random_points(5, 80, 4.0, 2);
  std::vector<PointForce> forces;
  point_forces(points, {0.5, 4.0}, forces);
  Vec2 total = Vec2::Zero();
  double torque = 0.0, size = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    total += forces[k].force;
    torque += cross(points.at[k], forces[k].force);
    size += forces[k].force.norm();
  }
  EXPECT_LT(total.norm(), 1e-6 * size);
  EXPECT_LT(std::abs(torque), 4.0 * 1e-6 * size);
  const std::vector<Vec2> plain = support::plain_forces(points, 0.5);
  Vec2 exact = Vec2::Zero();
  for (const Vec2& f : plain) exact += f;
  EXPECT_LT(exact.norm(), 1e-12 * size);
}

TEST(ForceField, PerpendicularStructuresAndPointsOfOneBodyExertNothing) {
  FieldPoints points;
  points.add({0, 0}, {1, 0}, 1.0, 0);
  points.add({0.1, 0}, {0, 1}, 1.0, 1);
  points.add({0, 0.1}, {1, 0}, 1.0, 0);
  std::vector<PointForce> forces;
  point_forces(points, {0.3, 4.0}, forces);
  for (const PointForce& f : forces) EXPECT_EQ(f.force, Vec2(0, 0));
}

TEST(ForceField, OfCoincidingPointsIsFiniteAndZero) {
  FieldPoints points;
  for (int b = 0; b < 3; ++b) points.add({5, -3}, {0, 1}, 1.0, b);
  std::vector<PointForce> forces;
  point_forces(points, {0.3, 4.0}, forces);
  for (const PointForce& f : forces) {
    EXPECT_EQ(f.force, Vec2(0, 0));
    EXPECT_TRUE(std::isfinite(f.stiffness));
  }
}

TEST(ForceField, OfNoPointsIsNone) {
  std::vector<PointForce> forces(3);
  point_forces({}, {0.3, 4.0}, forces);
  EXPECT_TRUE(forces.empty());
  EXPECT_EQ(potential({}, {0.3, 4.0}), 0.0);
}

Body bar(double length, const Vec2& middle) {
  Body body;
  for (int k = -10; k <= 10; ++k) body.points.emplace_back(middle + Vec2(length * k / 20.0, 0));
  body.directions.assign(body.points.size(), {1, 0});
  body.centre = middle;
  for (const Vec2& p : body.points) {
    body.inertia += (p - middle).squaredNorm();
    body.radius = std::max(body.radius, (p - middle).norm());
  }
  return body;
}

/// Centre of all masses must stay where it is: the bodies push each other only.
TEST(RigidStep, KeepsTheCentreOfMassAndTheShapeOfBodies) {
  std::vector<Body> bodies{bar(2.0, {0, 0}), bar(1.0, {0.3, 0.1})};
  bodies[1].points.resize(12);
  bodies[1].directions.resize(12);
  Vec2 centre = Vec2::Zero();
  for (const Vec2& p : bodies[1].points) centre += p / 12.0;
  bodies[1].centre = centre;
  std::vector<Pose2> poses{{0, 0, 0}, {0.1, 0.2, 0.3}};
  const auto centre_of_mass = [&] {
    return Vec2((bodies[0].mass() * (poses[0] * bodies[0].centre) + bodies[1].mass() * (poses[1] * bodies[1].centre)) /
                (bodies[0].mass() + bodies[1].mass()));
  };
  const Vec2 before = centre_of_mass();
  for (int round = 0; round < 200; ++round) {
    FieldPoints points;
    for (std::size_t b = 0; b < 2; ++b)
      for (std::size_t k = 0; k < bodies[b].points.size(); ++k)
        points.add(poses[b] * bodies[b].points[k], poses[b].rotate(bodies[b].directions[k]), 1.0, static_cast<int>(b));
    std::vector<PointForce> forces;
    point_forces(points, {0.5, 4.0}, forces);
    const auto drives = drives_of(bodies, poses, points, forces);
    move(bodies, drives, largest_step(drives), 0.5, poses);
  }
  EXPECT_LT((centre_of_mass() - before).norm(), 1e-6);
  for (const Pose2& p : poses) EXPECT_NEAR(std::hypot(p.cos(), p.sin()), 1.0, 1e-12);
  EXPECT_NEAR(std::remainder(poses[1].yaw() - poses[0].yaw(), kPi), 0.0, 0.02) << "parallel bars come to lie parallel";
}

TEST(RigidStep, MovesNoPointFartherThanTheLimit) {
  const std::vector<Body> bodies{bar(2.0, {0, 0})};
  std::vector<Pose2> poses{{1, 2, 0.5}};
  const std::vector<Pose2> before = poses;
  const std::vector<Drive> drives{{{3, 4}, 7.0, 1.0}};
  EXPECT_DOUBLE_EQ(move(bodies, drives, 1.0, 0.01, poses), 0.01);
  for (const Vec2& p : bodies[0].points) EXPECT_LE((poses[0] * p - before[0] * p).norm(), 0.01);
}

TEST(RigidStep, OfFaintSpringsIsNoLongerThanThatOfTheLeastOnesAllowed) {
  const std::vector<Drive> faint{{{1, 0}, 0.0, 1e-9}};
  EXPECT_DOUBLE_EQ(largest_step(faint), 1e9);
  EXPECT_DOUBLE_EQ(largest_step(faint, 4.0), 0.25);
  EXPECT_DOUBLE_EQ(largest_step(std::vector<Drive>{{{1, 0}, 0.0, 8.0}}, 4.0), 0.125) << "strong springs decide";
  EXPECT_EQ(largest_step({}), 0.0);
}

TEST(ForceField, StiffnessOnALineIsThatOfAPointBetweenThePointsOfOne) {
  const align::ffs::Field field{0.3, 4.0, 0.05};
  const double spacing = 0.07;
  FieldPoints points;
  for (int k = -100; k < 100; ++k) points.add({spacing * (k + 0.5), 0}, {1, 0}, 1.0, 0);
  points.add({0, 0}, {1, 0}, 1.0, 1);
  std::vector<PointForce> forces;
  point_forces(points, field, forces);
  EXPECT_NEAR(forces.back().stiffness, stiffness_on_line(spacing, field), 1e-4 * forces.back().stiffness);
}

TEST(Resampling, IsEquidistantAndKeepsBothEnds) {
  std::vector<Vec2> points;
  resample({{0, 0}, {1.03, 0}}, 0.1, points);
  ASSERT_EQ(points.size(), 12u) << "11 intervals of 9.4 cm";
  EXPECT_EQ(points.front(), Vec2(0, 0));
  EXPECT_EQ(points.back(), Vec2(1.03, 0));
  for (std::size_t k = 1; k < points.size(); ++k) EXPECT_NEAR((points[k] - points[k - 1]).norm(), 1.03 / 11, 1e-12);
  points.clear();
  resample({{0, 0}, {1e6, 0}}, 0.1, points);
  EXPECT_EQ(points.size(), 4096u);
}

}  // namespace
}  // namespace scanbench
