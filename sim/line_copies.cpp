// Copies the walls, and gives each copy a pose with its own error.
#include "sim/line_copies.hpp"

#include <utility>

#include "core/rng.hpp"
#include "core/scan.hpp"
#include "core/truth.hpp"

namespace scanbench::sim {

Recording line_copies(const World& world, const LineCopies& copies, std::uint64_t seed) {
  validate(world);
  Recording recording;
  recording.observed.sensor.name = "lines";
  Truth truth{.walls = world.walls, .world_from_sensor = {}, .ranges = {}, .wall_ids = {}};
  for (int k = 0; k < copies.copies; ++k) {
    CounterRng rng(seed, RngStream::pose, static_cast<std::uint32_t>(k));
    const double dx = copies.shift_sigma_m * rng.normal();
    const double dy = copies.shift_sigma_m * rng.normal();
    const double turn = copies.rotation_sigma_rad * rng.normal();
    Frame frame{.stamp_s = static_cast<double>(k), .ranges = {}, .odom_from_sensor = {dx, dy, turn}, .lines = {}};
    for (const Wall& wall : world.walls) frame.lines.push_back(wall.segment);
    recording.observed.frames.push_back(std::move(frame));
    truth.world_from_sensor.emplace_back();
  }
  recording.truth = std::move(truth);
  return recording;
}

}  // namespace scanbench::sim
