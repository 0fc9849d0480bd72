// Tables of walls: the walls are those of rows in YAML, and refusals name the line.
#include "harness/study/scenario/wall_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/rng.hpp"
#include "harness/io/yaml/writer.hpp"
#include "harness/study/scenario/effective.hpp"
#include "harness/study/scenario/scenario_file.hpp"
#include "harness/study/scenario/world_file.hpp"
#include "tests/support/inputs.hpp"

namespace scanbench::study {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string kHeader = "label,x1_m,y1_m,x2_m,y2_m\n";

std::vector<Wall> table_walls(const std::string& text) {
  return parse_wall_table(text, "w.csv");
}

std::string table_refusal(const std::string& text) {
  return support::config_refusal([&] { table_walls(text); });
}

TEST(WallTable, NamesItsColumnsInAnyOrder) {
  const auto walls = table_walls("y2_m,wall,x1_m,label,y1_m,x2_m\n4,0,1,\"a b\",2,3\n");
  ASSERT_EQ(walls.size(), 1U);
  EXPECT_EQ(walls[0].label, "a b");
  EXPECT_EQ(walls[0].segment.a, Vec2(1, 2));
  EXPECT_EQ(walls[0].segment.b, Vec2(3, 4));
}

TEST(WallTable, WithoutLabelsNumbersTheRows) {
  const auto walls = table_walls("x1_m,y1_m,x2_m,y2_m\n0,0,1,0\n0,0,0,1\n");
  ASSERT_EQ(walls.size(), 2U);
  EXPECT_EQ(walls[0].label, "1");
  EXPECT_EQ(walls[1].label, "2");
}

TEST(WallTable, RefusesWithTheLine) {
  EXPECT_THAT(table_refusal("label,x1_m,y1_m,x2_m\n"), StartsWith("w.csv:1: the column 'y2_m' is missing"));
  EXPECT_THAT(table_refusal("label,x1_m,y1_m,x2_m,y2_m,loss\n"), StartsWith("w.csv:1: unknown column 'loss'; allowed"));
  EXPECT_THAT(table_refusal("x1_m,x1_m,y1_m,x2_m,y2_m\n"), StartsWith("w.csv:1: two columns are called 'x1_m'"));
  EXPECT_THAT(table_refusal("x1_m;y1_m;x2_m;y2_m\n"), HasSubstr("allowed: commas"));
  const std::string good = kHeader + "a,0,0,1,0\n";
  for (const char* number : {"", "x", "inf", "nan", "1e999", "0x10", " 1", "1 ", "--1"})
    EXPECT_THAT(table_refusal(good + "b,0,0,1," + number + "\n"), StartsWith("w.csv:3: y2_m is ")) << number;
  EXPECT_THAT(table_refusal(good + "b,1,2,1,2\n"), StartsWith("w.csv:3: a wall without length"));
  EXPECT_THAT(table_refusal(good + "b,0,0,0,1\na,0,0,2,0\n"), StartsWith("w.csv:4: wall 'a' occurs a second time"));
  EXPECT_THAT(table_refusal(good + "b,0,0,1\n"), StartsWith("w.csv:3: found 4 fields"));
  for (const std::string& label : {std::string(), std::string(65, 'x'), std::string("\"a,b\""),
                                   std::string("\"a\"\"b\""), std::string("\"a\nb\""), std::string("a\tb")})
    EXPECT_THAT(table_refusal(good + label + ",0,0,1,1\n"), StartsWith("w.csv:3: label is ")) << label;
}

TEST(WallTable, NumbersAreTheDoublesOfTheCLibrary) {
  for (std::uint32_t i = 0; i < 2000; ++i) {
    CounterRng rng(5, RngStream::pose, i);
    const auto below = [&](double n) { return static_cast<std::size_t>(n * rng.uniform()); };
    std::string number(1 + below(18), '0');
    for (char& digit : number) digit = static_cast<char>('0' + below(10));
    if (const std::size_t point = 1 + below(18); point < number.size()) number.insert(point, ".");
    if (rng.uniform() < 0.5) number.insert(0, "-");
    const auto walls = table_walls(kHeader + "a," + number + ",0,1e20,1\n");
    EXPECT_EQ(walls[0].segment.a.x(), std::strtod(number.c_str(), nullptr)) << number;
  }
}

/// A world with random walls and labels that a table and YAML write in different ways.
sim::World random_world(int walls) {
  static const std::vector<std::string> kOdd = {"null", "~", "true", "0x10", "a b",
                                                "a: b", "#", "[x]",  "'",    "\xc3\xa4"};
  sim::World world;
  world.name = "w";
  for (int i = 0; i < walls; ++i) {
    CounterRng rng(9, RngStream::pose, static_cast<std::uint32_t>(i));
    const auto at = [&] { return (rng.uniform() - 0.5) * std::pow(10.0, std::floor(9 * rng.uniform()) - 5); };
    const auto index = static_cast<std::size_t>(i);
    world.walls.push_back({index < kOdd.size() ? kOdd[index] : std::to_string(i), {{at(), at()}, {at(), at()}}});
  }
  return world;
}

TEST(WallTable, OfAWorldIsTheWorldThatYamlLists) {
  const support::TemporaryFolder folder;
  const sim::World world = random_world(500);
  folder.write("walls.csv", wall_table(world.walls));
  const std::string rows = "schema: 1\n" + io::write_yaml(to_yaml(world));
  const std::string table = "schema: 1\n" + io::write_yaml(to_yaml(world, "walls.csv"));
  EXPECT_EQ(table, "schema: 1\nname: w\nsegments:\n  file: walls.csv\n");
  const sim::World listed = load_world(folder.write("rows.yaml", rows)).world;
  const sim::World named = load_world(folder.write("table.yaml", table)).world;
  EXPECT_EQ(io::write_yaml(to_yaml(named)), io::write_yaml(to_yaml(world)));
  EXPECT_EQ(io::write_yaml(to_yaml(listed)), io::write_yaml(to_yaml(world)));
  EXPECT_EQ(wall_table(named.walls), wall_table(world.walls));
}

TEST(WallTable, IsInMetresBesideOtherWallsOfAWorld) {
  const support::TemporaryFolder folder;
  folder.write("walls.csv", kHeader + "a,0,0,4,2\n");
  const auto load = [&](const std::string& rest) {
    return load_world(folder.write("w.yaml", "schema: 1\nunit_m: 0.5\nsegments: {file: walls.csv}\n" + rest)).world;
  };
  const sim::World world = load("polylines: {f: [[0, 0], [2, 0]]}\nlosses: {a: 0.5}\n");
  ASSERT_EQ(world.walls.size(), 2U);
  EXPECT_EQ(world.walls[0].segment.b, Vec2(4, 2));
  EXPECT_EQ(world.walls[1].segment.b, Vec2(1, 0));
  EXPECT_EQ(world.losses, (std::vector<double>{0.5, 0}));
}

TEST(WallTable, OfAWorldIsRefusedWithThePlace) {
  const support::TemporaryFolder folder;
  folder.write("walls.csv", kHeader + "f.1,0,0,4,2\n");
  const auto refusal = [&](const std::string& text) {
    return support::config_refusal([&] { load_world(folder.write("w.yaml", "schema: 1\n" + text)); });
  };
  const std::string good = "segments: {file: walls.csv}\n";
  EXPECT_EQ(refusal(good), "");
  EXPECT_THAT(refusal("segments: {file: none.csv}\n"), HasSubstr("w.yaml:2:18: no such file: "));
  EXPECT_THAT(refusal("segments: {}\n"), HasSubstr("w.yaml:2:11: "));
  EXPECT_THAT(refusal("segments: {file: walls.csv, unit: 1}\n"), HasSubstr("w.yaml:2:29: "));
  EXPECT_THAT(refusal("segments: 5\n"), HasSubstr("[label, x1, y1, x2, y2], or {file: TABLE}"));
  EXPECT_THAT(refusal(good + "polylines: {f: [[0, 0], [2, 0]]}\n"),
              HasSubstr("w.yaml:3:25: wall f.1 occurs a second time; the first is in line 2"));
  folder.write("walls.csv", kHeader + "a,0,0,4,x\n");
  EXPECT_THAT(refusal(good), HasSubstr("walls.csv:2: y2_m is 'x'; allowed: a number"));
  folder.write("walls.csv", kHeader);
  EXPECT_THAT(refusal(good), HasSubstr("the world has no walls"));
}

TEST(WallTable, OfAWorldInsideAScenarioIsBesideTheScenario) {
  const support::TemporaryFolder folder;
  folder.write("walls.csv", kHeader + "a,0,0,4,0.125\nb,4,0,4,-2.5\n");
  const std::string head =
      "schema: 1\nsensor: {preset: ladar_2d30}\ntrajectory: {kind: waypoints, points_m: {A: [1, 1], B: [2, 1]}, scans: "
      "2}\nworld:\n  name: w\n  segments: ";
  const auto effective = [&](const std::string& segments) {
    return effective_yaml(load_scenario(folder.write("s.yaml", head + segments + "\n")));
  };
  EXPECT_EQ(effective("{file: walls.csv}"), effective("[[a, 0, 0, 4, 0.125], [b, 4, 0, 4, -2.5]]"));
}

}  // namespace
}  // namespace scanbench::study
