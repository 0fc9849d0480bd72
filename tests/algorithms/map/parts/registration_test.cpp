// Registration of points on lines: exact recovery, open motions, shares.
#include "algorithms/map/parts/registration.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/scan_builder.hpp"

namespace scanbench::mapping {
namespace {

/// Points of the walls every 0.25 m, and pairs with the wall that each point came from.
struct Walls {
  Walls(std::vector<Segment> segments, const Pose2& pose) : walls(std::move(segments)), truth(pose) {
    for (std::size_t w = 0; w < walls.size(); ++w)
      for (double at = 0.0; at <= walls[w].length(); at += 0.25) {
        points.push_back(truth.inverse() * Vec2(walls[w].a + at * walls[w].direction()));
        of.push_back(w);
      }
  }
  FindPairs pairs() const {
    return [this](const Pose2& pose, double gate) {
      std::vector<PointOnLine> found;
      for (std::size_t k = 0; k < points.size(); ++k) {
        const Vec2 normal = perpendicular(walls[of[k]].direction());
        const PointOnLine pair{points[k], normal, normal.dot(walls[of[k]].a), 1.0};
        if (std::abs(normal.dot(pose * points[k]) - pair.offset_m) <= gate) found.push_back(pair);
      }
      return found;
    };
  }
  Registration on(const Pose2& predicted, const RegistrationRule& rule = {}) const {
    return register_on_lines(pairs(), predicted, static_cast<double>(points.size()), 3.0, rule);
  }

  std::vector<Segment> walls;
  Pose2 truth;
  std::vector<Vec2> points;
  std::vector<std::size_t> of;
};

TEST(Registration, FindsThePoseInARoomExactly) {
  const Walls room(support::box(-3, -2, 4, 2), {0.5, 0.3, 0.2});
  const Registration found = room.on({0.6, 0.2, 0.24});
  EXPECT_EQ(found.status, Status::converged);
  EXPECT_NEAR((found.map_from_sensor.translation() - room.truth.translation()).norm(), 0, 1e-9);
  EXPECT_NEAR(found.map_from_sensor.yaw(), 0.2, 1e-9);
  EXPECT_NEAR(found.share, 1.0, 1e-12);
}

TEST(Registration, DoesNotMoveAnExactPrediction) {
  const Walls room(support::box(-3, -2, 4, 2), {0.5, 0.3, 0.2});
  const Registration found = room.on(room.truth);
  EXPECT_NEAR((found.map_from_sensor.translation() - room.truth.translation()).norm(), 0, 1e-12);
  EXPECT_NEAR(found.map_from_sensor.yaw(), 0.2, 1e-12);
}

/// Pairs of a corridor along x; while the gate is wide also with a wall across it that is not the point's own.
FindPairs corridor_with_a_stray(const Walls& corridor, double stray_from_m) {
  return [&corridor, stray_from_m](const Pose2& pose, double gate) {
    std::vector<PointOnLine> found = corridor.pairs()(pose, gate);
    const double off = std::abs((pose * Vec2(3, 0)).x() - 3.3);
    if (gate > stray_from_m && off <= gate)
      for (int k = 0; k < 10; ++k) found.push_back({Vec2(3, 0.2 * k - 1), Vec2(1, 0), 3.3, 1.0});
    return found;
  };
}

TEST(Registration, AMotionThatIsOpenAtTheEndIsAsPredictedHoweverItMovedBefore) {
  const Walls corridor({{{-10, -1}, {10, -1}}, {{10, 1}, {-10, 1}}}, {0, 0, 0});
  const Pose2 predicted(0.02, 0.03, 0.01);
  const Registration found = register_on_lines(corridor_with_a_stray(corridor, 0.2), predicted,
                                               static_cast<double>(corridor.points.size()), 3.0, {});
  EXPECT_EQ(found.status, Status::degenerate);
  EXPECT_EQ(found.rank, 2);
  EXPECT_NEAR(found.map_from_sensor.x(), 0.02, 1e-3) << "the stray moved it by 0.3 m";
  EXPECT_NEAR(found.map_from_sensor.y(), 0.0, 1e-6);
  EXPECT_NEAR(found.map_from_sensor.yaw(), 0.0, 1e-6);
}

TEST(Registration, AFarCorrectionMustFitBetterThanANearOne) {
  const Walls corridor({{{-10, -1}, {10, -1}}, {{10, 1}, {-10, 1}}}, {0, 0, 0});
  const Pose2 predicted(0.02, 0.03, 0.01);
  const auto all = static_cast<double>(corridor.points.size());
  const FindPairs pairs = corridor_with_a_stray(corridor, 0.05);  // the stray stays a pair to the end
  EXPECT_NEAR(register_on_lines(pairs, predicted, all, 3.0, {}).map_from_sensor.x(), 0.3, 1e-6);
  const Registration near = register_near(pairs, predicted, all, 3.0, {});
  EXPECT_EQ(near.status, Status::degenerate);
  EXPECT_NEAR(near.map_from_sensor.x(), 0.02, 1e-3);

  // A prediction that is off by more than the narrow gate is corrected, because nothing fits there.
  const Walls room(support::box(-3, -2, 4, 2), {0.5, 0.3, 0.2});
  const Registration off =
      register_near(room.pairs(), {0.8, 0.1, 0.24}, static_cast<double>(room.points.size()), 3.0, {});
  EXPECT_EQ(off.status, Status::converged);
  EXPECT_NEAR((off.map_from_sensor.translation() - room.truth.translation()).norm(), 0, 1e-9);
}

TEST(Registration, LeavesTheOpenMotionOfACorridorAsPredicted) {
  const Walls corridor({{{-10, -1}, {10, -1}}, {{10, 1}, {-10, 1}}}, {0, 0, 0});
  const Registration found = corridor.on({0.3, 0.1, 0.02});
  EXPECT_EQ(found.status, Status::degenerate);
  EXPECT_EQ(found.rank, 2);
  EXPECT_NEAR(found.map_from_sensor.x(), 0.3, 1e-6);
  EXPECT_NEAR(found.map_from_sensor.y(), 0.0, 1e-6);
  EXPECT_NEAR(found.map_from_sensor.yaw(), 0.0, 1e-9);
}

TEST(Registration, WithTooFewPartnersIsNoMatchAtThePredictedPose) {
  const Walls room(support::box(-3, -2, 4, 2), {0, 0, 0});
  const Registration found = room.on({5, 5, 0});
  EXPECT_EQ(found.status, Status::no_match);
  EXPECT_TRUE(found.map_from_sensor == Pose2(5, 5, 0));
  EXPECT_NE(explained(found, {}), "");
}

TEST(Search, FindsATurnThatIsTooLargeForTheGates) {
  const Walls room(support::box(-3, -2, 4, 2), {0.5, 0.3, 0.2});
  const Pose2 slipped(0.5, 0.3, 0.2 - radians(38));
  const RegistrationRule rule{.search_rad = radians(40)};
  const Locate locate = [&](const Pose2& from) { return room.on(from, rule); };
  const Registration found = with_search(locate, slipped, rule);
  EXPECT_EQ(found.status, Status::converged);
  EXPECT_NEAR(found.map_from_sensor.yaw(), 0.2, 1e-9);
  EXPECT_NE(locate(slipped).status, Status::converged);
}

TEST(Search, IsNotMadeWhereThePredictionFitsWell) {
  const Walls room(support::box(-3, -2, 4, 2), {0, 0, 0});
  int calls = 0;
  const RegistrationRule rule{.search_rad = radians(40)};
  with_search(
      [&](const Pose2& from) {
        ++calls;
        return room.on(from, rule);
      },
      {0.05, 0, 0}, rule);
  EXPECT_EQ(calls, 1);
}

TEST(Search, ThatFindsNothingStaysAtThePrediction) {
  int calls = 0;
  const RegistrationRule rule{.search_rad = radians(40)};
  const Registration found = with_search(
      [&](const Pose2& from) {
        ++calls;
        return Registration{.status = Status::no_match, .map_from_sensor = from};
      },
      {1, 2, 0.5}, rule);
  EXPECT_EQ(calls, 9);  // 0, 10, -10, .. -40 degrees
  EXPECT_TRUE(found.map_from_sensor == Pose2(1, 2, 0.5));
}

TEST(FromStep, AScanThatDoesNotMeetTheMapStaysWhereTheScanBeforePutsIt) {
  const Walls room(support::box(-3, -2, 4, 2), {0, 0, 0});
  const RegistrationRule rule{};
  const Locate locate = [&](const Pose2& from) { return room.on(from, rule); };
  const Registration away = from_step(locate, Pose2(50, 5, 1), Pose2(49, 5, 1), rule);
  EXPECT_EQ(away.status, Status::converged);
  EXPECT_TRUE(away.by_step);
  EXPECT_TRUE(away.map_from_sensor == Pose2(50, 5, 1));
  EXPECT_NE(explained(away, rule), "");

  const Registration here = from_step(locate, Pose2(0.1, 0.05, 0.02), Pose2(50, 5, 1), rule);
  EXPECT_FALSE(here.by_step);
  EXPECT_NEAR(here.map_from_sensor.translation().norm(), 0.0, 1e-6);
  EXPECT_EQ(from_step(locate, std::nullopt, Pose2(50, 5, 1), rule).status, Status::no_match);
}

TEST(Registration, OfNothingIsNoMatch) {
  const FindPairs nothing = [](const Pose2&, double) { return std::vector<PointOnLine>{}; };
  EXPECT_EQ(register_on_lines(nothing, {}, 0.0, 1.0, {}).status, Status::no_match);
}

}  // namespace
}  // namespace scanbench::mapping
