// The reader of rows of walls: which texts it takes, and that it never disagrees with the YAML parser.
#include "harness/scenario/wall_rows.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "core/rng.hpp"
#include "harness/scenario/effective.hpp"
#include "harness/scenario/scenario_file.hpp"
#include "harness/scenario/world_file.hpp"
#include "harness/yaml/writer.hpp"
#include "tests/support/inputs.hpp"

namespace scanbench::harness {
namespace {

constexpr const char* kHead = "schema: 1\nsegments:\n";

/// Whether the text is read without the YAML parser's help for its rows.
bool has_canonical_rows(const std::string& text) {
  const auto rows = take_wall_rows(text);
  if (!rows) return false;
  try {
    return rows->belong_to(parse_yaml(rows->rest));
  } catch (const ConfigError&) {
    return false;
  }
}

/// What a reader says of a text: the message of its refusal, or the world to the last bit.
template <class Read>
std::string answer(Read read, const std::string& text) {
  try {
    const sim::World world = read(text, "w.yaml");
    std::string bits = write_yaml(to_yaml(world)) + world.name;
    for (const Wall& wall : world.walls)
      for (const double v : {wall.segment.a.x(), wall.segment.a.y(), wall.segment.b.x(), wall.segment.b.y()}) {
        char bytes[sizeof v];
        std::memcpy(bytes, &v, sizeof v);
        bits.append(bytes, sizeof v);
      }
    return bits;
  } catch (const ConfigError& error) {
    return error.what();
  }
}

std::string plain_row(const std::string& label, const std::string& x1) {
  return "  - [" + label + ", " + x1 + ", 0, 100, 1]\n";
}

TEST(WallRows, TakesTheFormThatTheProjectWrites) {
  sim::World world;
  world.name = "halls";
  world.about = "a: b";
  for (int i = 0; i < 20; ++i) world.walls.push_back({std::to_string(i), {{0.1 * i, 1e-7}, {-4, 1e5 + i}}});
  world.walls.push_back({"null", {{1, 2}, {3, 4}}});
  world.walls.push_back({"q.4", {{1, 2}, {3, 4}}});
  world.circles.push_back({"c", {1, 2}, 0.5});
  const std::string text = "schema: 1\n" + write_yaml(to_yaml(world));
  EXPECT_TRUE(has_canonical_rows(text));
  EXPECT_EQ("schema: 1\n" + write_yaml(to_yaml(parse_world(text, "w.yaml"))), text);
}

TEST(WallRows, TakesCommentsBlankLinesAndAnyIndentation) {
  EXPECT_TRUE(has_canonical_rows(
      "schema: 1\nsegments:  # [label, x1, y1, x2, y2]\n\n - [a, 0, 0, 1, 0] # short\n# between\n - [b.2-c, 1e3, -0.5, "
      "1., 7E-2]  \n\nname: x\n"));
  EXPECT_TRUE(has_canonical_rows("schema: 1\nsegments:\n      - [a, 0, 0, 1, 0]"));
}

TEST(WallRows, ReadsNumbersToTheNearestDouble) {
  const sim::World world =
      parse_world(kHead + plain_row("a", "0.1") + plain_row("b", "-12345678901234567890e-18"), "w");
  EXPECT_EQ(world.walls[0].segment.a.x(), 0.1);
  EXPECT_EQ(world.walls[1].segment.a.x(), -12.345678901234567890);
}

TEST(WallRows, DecimalsOfAnyLengthAreTheDoublesOfTheCLibrary) {
  for (std::uint32_t i = 0; i < 20000; ++i) {
    CounterRng rng(9, RngStream::pose, i);
    const auto below = [&](double n) { return static_cast<std::size_t>(n * rng.uniform()); };
    std::string number;
    for (std::size_t k = 1 + below(18); k > 0; --k) number += static_cast<char>('0' + below(10));
    if (number.front() == '0' && number.size() > 1) number.front() = '1';
    if (const std::size_t point = 1 + below(18); point < number.size()) number.insert(point, ".");
    if (rng.uniform() < 0.5) number.insert(0, "-");
    const auto rows = take_wall_rows(kHead + plain_row("a", number));
    ASSERT_TRUE(rows) << number;
    const double read = rows->walls[0].segment.a.x();
    const double expected = std::strtod(number.c_str(), nullptr);
    ASSERT_EQ(std::memcmp(&read, &expected, sizeof read), 0) << number;
  }
}

TEST(WallRows, LeavesEveryOtherFormToTheParser) {
  const std::vector<std::string> rows = {"  - [\"a\\x20\", 0, 0, 1, 0]\n",
                                         "  - ['a', 0, 0, 1, 0]\n",
                                         "  - [a, \"0\", 0, 1, 0]\n",
                                         "  - [a,0,0,1,0]\n",
                                         "  - [ a, 0, 0, 1, 0 ]\n",
                                         "  -  [a, 0, 0, 1, 0]\n",
                                         "  - [a, 0, 0,\n     1, 0]\n",
                                         "  - &x [a, 0, 0, 1, 0]\n",
                                         "  - !t [a, 0, 0, 1, 0]\n",
                                         "  - [a, 0, 0, 1, 0, 0]\n",
                                         "  - [a, 0, 0, 1]\n",
                                         "  - [a, 0, 0, 1, 0]#c\n",
                                         "  - [a, 0, 0, 1, 0]\r\n",
                                         "\t- [a, 0, 0, 1, 0]\n",
                                         "  - [a,\t0, 0, 1, 0]\n",
                                         "  - [null, 0, 0, 1, 0]\n",
                                         "  - [~, 0, 0, 1, 0]\n",
                                         "  - [, 0, 0, 1, 0]\n",
                                         "  - [a, 00, 0, 1, 0]\n",
                                         "  - [a, 010.5, 0, 1, 0]\n",
                                         "  - [a, +1, 0, 1, 0]\n",
                                         "  - [a, .5, 0, 1, 0]\n",
                                         "  - [a, inf, 0, 1, 0]\n",
                                         "  - [a, .nan, 0, 1, 0]\n",
                                         "  - [a, 0x10, 0, 1, 0]\n",
                                         "  - [a, 1_0, 0, 1, 0]\n",
                                         "  - [a, 1e999, 0, 1, 0]\n",
                                         "  - [a, 1:2, 0, 1, 0]\n",
                                         "  - [a, *x, 0, 1, 0]\n",
                                         "  - [a, 0, 0, 1, 0] x\n",
                                         "  - [\xc3\xa4, 0, 0, 1, 0]\n",
                                         "  - [a b, 0, 0, 1, 0]\n",
                                         "- [a, 0, 0, 1, 0]\n",
                                         "  - [a, 0, 0, 1, 0]\x04\n",
                                         "  - [a, 0, 0, 1, 0] # \x04\n",
                                         "  - [a, 0, 0, 1, 0] # \xe2\x80\xa8\n",
                                         "  - {label: a, x: 1}\n",
                                         "  -\n    [a, 0, 0, 1, 0]\n",
                                         "  - - a\n    - 0\n    - 0\n    - 1\n    - 0\n",
                                         "  - [a, 0, 0, 1, 0]\n   - [b, 0, 1, 1, 1]\n",
                                         "  - [a, 0, 0, 1, 0]\n - [b, 0, 1, 1, 1]\n"};
  for (const auto& row : rows) {
    const std::string text = kHead + row;
    EXPECT_FALSE(has_canonical_rows(text)) << text;
    EXPECT_EQ(answer(parse_world, text), answer(parse_world_yaml, text)) << text;
    const std::string later = kHead + plain_row("first", "0") + row;
    EXPECT_FALSE(has_canonical_rows(later)) << later;
    EXPECT_EQ(answer(parse_world, later), answer(parse_world_yaml, later)) << later;
  }
}

TEST(WallRows, AKeyInsideATextOrAnotherMapIsNotTheKeyOfTheWorld) {
  const std::string row = "  - [a, 0, 0, 1, 0]\n", walls = "polygons: {g: [[3, 1], [4, 1], [4, 2]]}\n";
  for (const std::string& text :
       {"schema: 1\nabout: \"x\nsegments:\n" + row + " \"\n" + walls,
        "schema: 1\nabout: |\n  segments:\n  " + row + walls, "{schema: 1,\nsegments:\n" + row + "}\n",
        "schema: 1\nlosses:\n  segments:\n  " + row + walls,
        "schema: 1\n# \"\nsegments:\n" + row + "about: \"\nsegments:\n  - [b, 0, 0, 1, 0]\nx\"\n",
        "schema: 1\nsegments:\n" + row + "segments:\n" + row, "schema: 1\nsegments:\n" + row + "...\n",
        "schema: 1\nsegments:\n" + row + "---\nschema: 1\n", "- 1\nsegments:\n" + row,
        "schema: 1\nwhat:\n    segments:\n  " + row})
    EXPECT_EQ(answer(parse_world, text), answer(parse_world_yaml, text)) << text;
}

TEST(WallRows, RefusalsOfCanonicalRowsHaveTheParsersPlaces) {
  const auto refusal = [](const std::string& text) { return config_refusal([&] { parse_world(text, "w.yaml"); }); };
  EXPECT_EQ(refusal(kHead + plain_row("a", "0") + plain_row("a", "1")),
            "w.yaml:4:5: wall a occurs a second time; the first is in line 3");
  EXPECT_THAT(refusal(std::string(kHead) + "  - [a, 1, 2, 1, 2]\n"),
              testing::StartsWith("w.yaml:3:5: wall a has no l"));
  EXPECT_THAT(refusal(kHead + plain_row("a", "0") + "colour: red\n"), testing::StartsWith("w.yaml:4:1: "));
}

// A character of the alphabet, or a piece of a file.
std::string random_piece(CounterRng& rng) {
  static const std::vector<std::string> kPieces = {"  - [",
                                                   ", ",
                                                   "]\n",
                                                   "[",
                                                   "]",
                                                   "\n",
                                                   "  ",
                                                   " ",
                                                   "#",
                                                   " # c",
                                                   "\"",
                                                   "'",
                                                   "a",
                                                   "b.1",
                                                   "null",
                                                   "0",
                                                   "-1.5",
                                                   "1e3",
                                                   "007",
                                                   "\t",
                                                   "\r\n",
                                                   "{",
                                                   "}",
                                                   ":",
                                                   ": ",
                                                   "|\n",
                                                   "segments:",
                                                   "name: ",
                                                   "- ",
                                                   "\xc3\xa4",
                                                   "&x ",
                                                   "*x",
                                                   "!!int ",
                                                   "about:",
                                                   "losses:",
                                                   "---\n",
                                                   "...\n",
                                                   "polygons:\n  p: [[0, 0], [1, 0], [1, 1]]\n",
                                                   "segments: []\n",
                                                   ">\n"};
  return kPieces[static_cast<std::size_t>(rng.uniform() * static_cast<double>(kPieces.size()))];
}

// A canonical file with random numbers, into which up to three random pieces are inserted.
std::string random_text(std::uint32_t number) {
  CounterRng rng(7, RngStream::pose, number);
  const auto chance = [&](double p) { return rng.uniform() < p; };
  std::string text = "schema: 1\n";
  if (chance(0.3)) text += "about: \"some text: 'x'\"\n";
  if (chance(0.3)) text += "unit_m: 0.025\n";
  if (chance(0.2)) text += "polylines:\n  fence: [[0, 0], [6, 0], [6, 4]]\n";
  text += chance(0.3) ? "segments:  # rows\n" : "segments:\n";
  const std::string indent(1 + static_cast<std::size_t>(4 * rng.uniform()), ' ');
  const int rows = 1 + static_cast<int>(5 * rng.uniform());
  for (int r = 0; r < rows; ++r) {
    text += indent + "- [" + (chance(0.5) ? "w" : "") + std::to_string(r);
    for (int i = 0; i < 4; ++i)
      text += ", " + number_text((rng.uniform() - 0.5) * std::pow(10.0, std::floor(12 * rng.uniform()) - 6));
    text += "]" + std::string(chance(0.2) ? "  # near" : "") + (r + 1 < rows || chance(0.8) ? "\n" : "");
    if (chance(0.1)) text += "\n# more\n";
  }
  if (text.back() == '\n' && chance(0.4)) text += "circles:\n  - [c, 1, 2, 0.5]\n";
  const int pieces = chance(0.3) ? 0 : 1 + static_cast<int>(3 * rng.uniform());
  for (int p = 0; p < pieces; ++p)
    text.insert(static_cast<std::size_t>(rng.uniform() * static_cast<double>(text.size())), random_piece(rng));
  return text;
}

TEST(WallRows, RandomWorldsAreTheSameByBothReaders) {
  int canonical = 0, refused = 0;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    const std::string text = random_text(i), reference = answer(parse_world_yaml, text);
    ASSERT_EQ(answer(parse_world, text), reference) << text;
    canonical += has_canonical_rows(text);
    refused += reference.starts_with("w.yaml:");
  }
  // Most undisturbed files are read by the rows' reader, and most disturbances are errors.
  EXPECT_GT(canonical, 4000);
  EXPECT_GT(refused, 4000);
}

TEST(WallRows, AScenarioWithItsWorldInsideIsTheSameByBothReaders) {
  const std::string head =
      "schema: 1\nsensor: {preset: ladar_2d30}\ntrajectory: {kind: waypoints, points_m: {A: [1, 1], B: [2, 1]}, scans: "
      "2}\nworld:\n  name: w\n";
  const std::string rows = "    - [a, 0, 0, 4, 0.125]\n    - [b, 4, 0, 4, -2.5]\n";
  const auto effective = [](const std::string& text) {
    return effective_yaml(parse_scenario(text, "/nowhere/s.yaml"));
  };
  ASSERT_TRUE(take_wall_rows(head + "  segments:\n" + rows));
  EXPECT_EQ(effective(head + "  segments:\n" + rows), effective(head + "  \"segments\":\n" + rows));
  const auto refusal = [](const std::string& text) {
    return config_refusal([&] { parse_scenario(text, "/nowhere/s.yaml"); });
  };
  const std::string wrong = head + "  segments:\n" + rows + "seed: x\n";
  EXPECT_THAT(refusal(wrong), testing::StartsWith("/nowhere/s.yaml:9:7: "));
  const Scenario changed =
      parse_scenario(head + "  segments:\n" + rows, "/nowhere/s.yaml", {"world.segments=[[c, 0, 0, 1, 0]]"});
  EXPECT_EQ(std::get<SimulatedInput>(changed.input).world.walls.size(), 1U);
}

}  // namespace
}  // namespace scanbench::harness
