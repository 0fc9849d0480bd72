// Compares the reader of world files with yaml-cpp, on 100 000 walls, and prints rows of bench/ratios.hpp.
//
//   world_bench [rounds]     default: 11
//
// The world names a table of its walls, segments: {file: walls.csv}. The alternatives list the same walls as YAML: for
// yaml-cpp's tree, from which the numbers are taken, and for this program's reader. Checks of the world are part of
// both of its readers; the table is read from disk.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <yaml-cpp/yaml.h>

#include "bench/ratios.hpp"
#include "core/rng.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/io/yaml/writer.hpp"
#include "harness/study/scenario/wall_table.hpp"
#include "harness/study/scenario/world_file.hpp"

namespace scanbench::bench {
namespace {

// Walls of 0.3 m to 6 m with coordinates in whole centimetres.
sim::World random_world(int walls) {
  sim::World world;
  world.name = "walls";
  for (int i = 0; i < walls; ++i) {
    CounterRng rng(1, RngStream::pose, static_cast<std::uint32_t>(i));
    const auto at = [&](double size) { return std::round(100 * size * rng.uniform()) / 100; };
    const Vec2 a(at(500), at(500));
    world.walls.push_back({std::to_string(i + 1), {a, {a.x() + 0.3 + at(5.7), a.y() + at(3)}}});
  }
  return world;
}

std::string world_text(const sim::World& world, const std::string& table) {
  return "schema: 1\n" + io::write_yaml(study::to_yaml(world, table));
}

std::size_t load_by_tree(const std::string& text) {
  const YAML::Node root = YAML::Load(text);
  sim::World world;
  for (const auto& row : root["segments"])
    world.walls.push_back({row[0].as<std::string>(),
                           {{row[1].as<double>(), row[2].as<double>()}, {row[3].as<double>(), row[4].as<double>()}}});
  return world.walls.size();
}

}  // namespace
}  // namespace scanbench::bench

int main(int argc, char** argv) {
  using namespace scanbench;
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 11;
  const sim::World world = bench::random_world(100000);
  std::string folder = (std::filesystem::temp_directory_path() / "scanbench-walls-XXXXXX").string();
  if (::mkdtemp(folder.data()) == nullptr) return 1;
  const std::string table = folder + "/walls.csv";
  io::write_file_atomically(table, study::wall_table(world.walls));
  const std::string rows = bench::world_text(world, ""), named = bench::world_text(world, table);
  const auto load = [](const std::string& text) { return study::parse_world(text, "w.yaml").walls.size(); };
  const bench::Method reader{"table of walls", [&] { return load(named); }, 50};
  bench::measure("load 100 000 walls, a wall", {{"yaml-cpp", [&] { return bench::load_by_tree(rows); }}, reader},
                 rounds);
  bench::measure("load 100 000 walls, a wall", {{"rows in YAML", [&] { return load(rows); }}, reader}, rounds);
  std::filesystem::remove_all(folder);
}
