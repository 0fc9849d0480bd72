// World files: their meaning, and the shipped ones.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "harness/io/files/text_file.hpp"
#include "harness/io/yaml/writer.hpp"
#include "harness/study/scenario/world_file.hpp"
#include "tests/support/inputs.hpp"

namespace scanbench::study {
namespace {

using testing::HasSubstr;

sim::World world_of(const std::string& body) {
  return parse_world("schema: 1\n" + body, "w.yaml");
}

TEST(WorldFile, UnitsScaleCoordinatesButNotWhatIsInMetresByName) {
  const sim::World world = world_of(
      "unit_m: 0.5\nsegments: [[a, 0, 0, 4, 2]]\ncircles: [[c, 2, 4, 1]]\n"
      "moving: [{label: p, radius_m: 0.2, path_m: [[1, 1], [2, 1]], speed_mps: 1}]\n");
  EXPECT_EQ(world.walls[0].segment.b, Vec2(2, 1));
  EXPECT_EQ(world.circles[0].center, Vec2(1, 2));
  EXPECT_EQ(world.circles[0].radius_m, 0.5);
  EXPECT_EQ(world.moving[0].path[0], Vec2(1, 1));
  EXPECT_FALSE(world.moving[0].loop);
  EXPECT_EQ(world.name, "w");
}

TEST(WorldFile, PolygonsAreClosedAndPolylinesAreNot) {
  const sim::World world =
      world_of("polylines: {f: [[0, 0], [1, 0], [1, 1]]}\npolygons: {g: [[3, 0], [4, 0], [4, 1]]}\n");
  ASSERT_EQ(world.walls.size(), 5U);
  EXPECT_EQ(world.walls[1].label, "f.2");
  EXPECT_EQ(world.walls[4].label, "g.3");
  EXPECT_EQ(world.walls[4].segment.a, Vec2(4, 1));
  EXPECT_EQ(world.walls[4].segment.b, Vec2(3, 0));
}

TEST(WorldFile, LossesAreOfTheWallsThatTheyName) {
  const std::string walls = "segments: [[a, 0, 0, 4, 0]]\npolygons: {g: [[3, 1], [4, 1], [4, 2]]}\n";
  EXPECT_TRUE(world_of(walls).losses.empty());
  const sim::World world = world_of(walls + "losses: {g.2: 0.6, a: 1}\n");
  EXPECT_EQ(world.losses, (std::vector<double>{1, 0, 0.6, 0}));
  const io::YamlNode again = to_yaml(world);
  EXPECT_EQ(parse_world("schema: 1\n" + io::write_yaml(again), "w.yaml").losses, world.losses);
  const auto message_of = [&](const std::string& losses) {
    try {
      world_of(walls + losses);
      return std::string();
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_THAT(message_of("losses: {b: 1}\n"), HasSubstr("w.yaml:4:10: losses names a wall"));
  EXPECT_THAT(message_of("losses: {a: 1.5}\n"),
              HasSubstr("w.yaml:4:13: a loss is 1.5; allowed: a probability, 0 .. 1"));
  EXPECT_THAT(message_of("losses: [a]\n"), HasSubstr("w.yaml:4:9: losses is"));
}

TEST(WorldFile, NumericLabelsAreWords) {
  EXPECT_EQ(world_of("segments: [[15, 0, 0, 1, 0]]\n").walls[0].label, "15");
}

TEST(WorldFile, WritesAWorldThatReadsBackToTheSameNumbers) {
  const sim::World world = world_of(
      "about: \"a: b\"\nunit_m: 0.1\nsegments: [[\"1\", 0.1, 0.7, 1.3, -0.9]]\npolygons: {q: [[3, 0], [4, 0.3], [4, "
      "1]]}\n"
      "circles: [[c, 2, 4, 1]]\nmoving: [{label: p, radius_m: 0.2, path_m: [[1, 1], [2, 1]], speed_mps: 1, loop: "
      "true}]\n");
  const std::string text = io::write_yaml(to_yaml(world));
  const sim::World back = parse_world("schema: 1\n" + text, "other.yaml");
  EXPECT_EQ(io::write_yaml(to_yaml(back)), text);
  ASSERT_EQ(back.walls.size(), world.walls.size());
  for (std::size_t i = 0; i < world.walls.size(); ++i) {
    EXPECT_EQ(back.walls[i].label, world.walls[i].label);
    EXPECT_EQ(back.walls[i].segment, world.walls[i].segment);
  }
  EXPECT_TRUE(back.moving[0].loop);
  EXPECT_EQ(back.name, "w");
}

TEST(WorldFile, EveryShippedWorldLoads) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(support::source_dir() / "scenarios/worlds")) {
    EXPECT_NO_THROW(load_world(entry.path())) << entry.path();
    ++count;
  }
  EXPECT_GT(count, 5);
  EXPECT_EQ(load_world(support::source_dir() / "scenarios/worlds/borges15.yaml").world.walls.size(), 15U);
  EXPECT_EQ(load_world(support::source_dir() / "scenarios/worlds/spiral.yaml").world.walls.size(), 30U);
  // 400 units of the arena are 10 m.
  EXPECT_EQ(load_world(support::source_dir() / "scenarios/worlds/four_rooms.yaml").world.walls[6].segment.b,
            Vec2(10, 5.125));
}

TEST(VectorMap, ReadsCommasAndBlanksAndDropsWhatHasNoLength) {
  const LoadedWorld map =
      parse_vector_map("# a map\n0, 0, 1, 0\n1,0,1,2\n\n2 2 2 2\n0 0 0 5 # wall\r\n", "m.vectormap.txt");
  ASSERT_EQ(map.world.walls.size(), 3U);
  EXPECT_EQ(map.dropped, 1);
  EXPECT_EQ(map.world.walls[1].label, "3");
  EXPECT_EQ(map.world.walls[2].segment.b, Vec2(0, 5));
  EXPECT_EQ(map.world.name, "m");
}

TEST(VectorMap, RefusesWhatIsNoSegmentWithItsPlace) {
  const auto refusal = [](const std::string& text) {
    return support::config_refusal([&] { parse_vector_map(text, "m.txt"); });
  };
  EXPECT_THAT(refusal("0, 0, 1, 0\n0, 0, x, 0\n"), HasSubstr("m.txt:2:7: 'x' is not a number"));
  EXPECT_THAT(refusal("0, 0, 1\n"), HasSubstr("m.txt:1:1: 3 numbers in a line"));
  EXPECT_THAT(refusal("0, 0,, 1\n"), HasSubstr("m.txt:1:6: '' is not a number"));
  EXPECT_THAT(refusal("0 0 nan 1\n"), HasSubstr("m.txt:1:5: 'nan' is not a number"));
  EXPECT_THAT(refusal("1 1 1 1\n"), HasSubstr("the world has no walls"));
  EXPECT_THAT(refusal(""), HasSubstr("the world has no walls"));
}

TEST(VectorMap, RealBuildingMapsHaveTheirKnownSizes) {
  const auto folder = support::data_dir() / "worlds-amrl-a";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "worlds-amrl-a is not there";
  EXPECT_EQ(load_world(folder / "GDC1.vectormap.txt.gz").world.walls.size(), 1289U);
  const LoadedWorld ase = load_world(folder / "ASE4.vectormap.txt.gz");
  EXPECT_EQ(ase.world.walls.size() + static_cast<std::size_t>(ase.dropped), 3598U);
  EXPECT_EQ(ase.dropped, 1);
}

TEST(TextFile, RefusesWhatIsNoRegularFileOrDamaged) {
  EXPECT_THAT(support::config_refusal([] { io::read_text_file("/nonexistent/x", 10); }), HasSubstr("no such file"));
  EXPECT_THAT(support::config_refusal([] { io::read_text_file("/dev/zero", 10); }), HasSubstr("not a regular file"));
  const support::TemporaryFolder pictures;
  const std::string png("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);
  EXPECT_THAT(support::config_refusal([&] { load_world(pictures.write("plan.png", png)); }),
              testing::AllOf(HasSubstr("plan.png:3:1: a byte 0"), HasSubstr("a world file in YAML, or a vector map")));
  EXPECT_THAT(support::config_refusal([] { io::read_text_file("/", 10); }), HasSubstr("not a regular file"));
  const support::TemporaryFolder folder;
  const auto plain = folder.write("a.txt", "hello");
  EXPECT_EQ(io::read_text_file(plain, 10), "hello");
  EXPECT_THAT(support::config_refusal([&] { io::read_text_file(plain, 4); }), HasSubstr("larger than 4 B"));
  const std::string packed = support::gzip(std::string(100000, 'x') + "end");
  EXPECT_EQ(io::read_text_file(folder.write("a.gz", packed), 200000).size(), 100003U);
  EXPECT_THAT(support::config_refusal(
                  [&] { io::read_text_file(folder.write("b.gz", packed.substr(0, packed.size() / 2)), 200000); }),
              HasSubstr("the gzip data ends early"));
  std::string damaged = packed;
  damaged[packed.size() - 6] = static_cast<char>(damaged[packed.size() - 6] ^ 1);  // in the checksum
  EXPECT_THAT(support::config_refusal([&] { io::read_text_file(folder.write("c.gz", damaged), 200000); }),
              HasSubstr("c.gz: "));
  EXPECT_THAT(support::config_refusal([&] { io::read_text_file(folder.write("d.gz", packed), 1000); }),
              HasSubstr("larger than"));
}

}  // namespace
}  // namespace scanbench::study
