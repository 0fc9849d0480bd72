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

/// A world. With an empty `file` it is the L-shaped room or random rooms.
struct Scene {
  std::string name;
  std::string file;            ///< in scenarios/worlds, or a whole path
  bool random_rooms = false;   ///< a new room for every 25 scans
  double least_returns = 0.9;  ///< share of directions that must hit a wall; distinguishes inside from outside
  int scans = 300;             ///< number of scans per seed
  bool in_pairs = false;       ///< each random pose is followed by one up to 0.3 m and 10 degrees from it
};

/// All scenes. `optimal` was developed on seeds below 100.
const std::vector<Scene>& scenes();

/// The scans of a scene from random poses at least 0.3 m from all walls, with 451 beams over 270 degrees, a range of 30
/// m and Gaussian noise. There is one recording per world; random rooms have one for each 25 scans. The same seed gives
/// the same recordings.
std::vector<Recording> recordings(const Scene& scene, double sigma_m, std::uint64_t seed);

}  // namespace scanbench::accuracy
