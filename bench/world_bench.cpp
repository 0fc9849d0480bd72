// Compares the reader of world files with yaml-cpp, on 100 000 walls, and prints rows of bench/ratios.hpp.
//
//   world_bench [rounds]     default: 11
//
// The alternatives are yaml-cpp's tree, from which the numbers are taken, and this program's reader without its own
// reader of rows. Both are handed the text of the file; the checks of the world are part of the two readers.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>

#include <yaml-cpp/yaml.h>

#include "bench/ratios.hpp"
#include "core/rng.hpp"
#include "harness/scenario/world_file.hpp"
#include "harness/yaml/writer.hpp"

namespace scanbench::bench {
namespace {

// Walls of 0.3 m to 6 m with coordinates in whole centimetres.
std::string world_text(int walls) {
  sim::World world;
  world.name = "walls";
  for (int i = 0; i < walls; ++i) {
    CounterRng rng(1, RngStream::pose, static_cast<std::uint32_t>(i));
    const auto at = [&](double size) { return std::round(100 * size * rng.uniform()) / 100; };
    const Vec2 a(at(500), at(500));
    world.walls.push_back({std::to_string(i + 1), {a, {a.x() + 0.3 + at(5.7), a.y() + at(3)}}});
  }
  return "schema: 1\n" + harness::write_yaml(harness::to_yaml(world));
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
  const std::string text = bench::world_text(100000);
  const bench::Method reader{"world reader", [&] { return harness::parse_world(text, "w.yaml").walls.size(); }, 50};
  bench::measure("load 100 000 walls, a wall", {{"yaml-cpp", [&] { return bench::load_by_tree(text); }}, reader},
                 rounds);
  bench::measure(
      "load 100 000 walls, a wall",
      {{"reader by yaml-cpp alone", [&] { return harness::parse_world_yaml(text, "w.yaml").walls.size(); }}, reader},
      rounds);
}
