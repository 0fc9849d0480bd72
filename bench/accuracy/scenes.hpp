// Scenes for measuring the accuracy of extractors: the worlds of scenarios/worlds and rooms generated from a seed, each
// seen from random places in its free space.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/recording.hpp"
#include "sim/world.hpp"

namespace scanbench::accuracy {

/// A world, or with an empty `file` the L-shaped room or random rooms.
struct Scene {
  std::string name;
  std::string file;            ///< in scenarios/worlds, or with a whole path
  bool random_rooms = false;   ///< another room for every 25 scans
  double least_returns = 0.9;  ///< share of directions that must hit a wall: distinguishes inside from outside
  int scans = 300;             ///< per seed
};

/// All of them. `optimal` was developed on seeds below 100.
const std::vector<Scene>& scenes();

/// The scans of a scene from random poses at least 0.3 m from all walls: 451 beams over 270 degrees, 30 m, Gaussian
/// noise. One recording per world (25 scans each of random rooms, else one). The same seed gives the same recordings.
std::vector<Recording> recordings(const Scene& scene, double sigma_m, std::uint64_t seed);

}  // namespace scanbench::accuracy
