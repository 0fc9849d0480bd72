// Worlds that are refused, and positions of moving bodies.
#include "sim/world.hpp"

#include <functional>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/geometry/geometry.hpp"
#include "tests/sim/test_worlds.hpp"

namespace scanbench::sim {
namespace {

using ::testing::HasSubstr;

std::string complaint(const std::function<void(World&)>& spoil) {
  World world = test::box_world(4.0, 3.0);
  world.circles.push_back({"pillar", {2, 2}, 0.1});
  world.moving.push_back({"person", 0.3, {{1, 1}, {3, 1}}, 1.0, true});
  EXPECT_NO_THROW(validate(world));
  spoil(world);
  try {
    validate(world);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "no error";
}

TEST(World, FaultsAreNamed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(complaint([](World& w) { w.walls.clear(); }), HasSubstr("'box' has no walls"));
  EXPECT_THAT(complaint([](World& w) { w.walls[2].segment.b = w.walls[2].segment.a; }),
              HasSubstr("wall 'w3' (number 3) has no length: both ends are at (4, 3) m"));
  EXPECT_THAT(complaint([&](World& w) { w.walls[1].segment.b.x() = nan; }), HasSubstr("wall 'w2'"));
  EXPECT_THAT(complaint([](World& w) { w.walls[1].label = "w1"; }), HasSubstr("label of another wall"));
  EXPECT_THAT(complaint([](World& w) { w.walls[1].segment.b.x() = 1e6; }), HasSubstr("from its centre"));
  EXPECT_THAT(complaint([](World& w) { w.circles[0].radius_m = 0; }), HasSubstr("'pillar' has radius_m 0; allowed"));
  EXPECT_THAT(complaint([&](World& w) { w.circles[0].center.y() = nan; }), HasSubstr("'pillar'"));
  EXPECT_THAT(complaint([](World& w) { w.moving[0].radius_m = -1; }), HasSubstr("'person' has radius_m -1"));
  EXPECT_THAT(complaint([&](World& w) { w.moving[0].speed_mps = nan; }), HasSubstr("'person' has speed_mps nan"));
  EXPECT_THAT(complaint([](World& w) { w.moving[0].path.pop_back(); }), HasSubstr("path without length"));
}

TEST(MovingBody, WalksItsPathByArcLengthAndStaysAtTheEnd) {
  MovingBody body{"person", 0.3, {{0, 0}, {3, 0}, {3, 4}}, 2.0, false};
  EXPECT_EQ(body.position(-1.0), Vec2(0, 0));
  EXPECT_EQ(body.position(1.0), Vec2(2, 0));
  EXPECT_EQ(body.position(2.5), Vec2(3, 2));
  EXPECT_EQ(body.position(100.0), Vec2(3, 4));
}

TEST(MovingBody, LoopsBackAndForth) {
  const MovingBody body{"person", 0.3, {{0, 0}, {3, 0}, {3, 4}}, 1.0, true};
  EXPECT_EQ(body.position(7.0), Vec2(3, 4));
  EXPECT_EQ(body.position(9.0), Vec2(3, 2));
  EXPECT_EQ(body.position(13.0), Vec2(1, 0));
  EXPECT_EQ(body.position(15.0), Vec2(1, 0));
}

}  // namespace
}  // namespace scanbench::sim
