// Counter-based random numbers: Philox4x32-10 (Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC 2011).
//
// A draw depends only on (seed, stream, frame, beam) and on how many draws of the same address came before it: the same
// bytes for any number of threads and any order of work. No algorithm's name ever enters an address, so all algorithms
// of a comparison see the same noise.
#pragma once

#include <array>
#include <cstdint>

namespace scanbench {

/// What a draw is for. The numbers stand in recordings' bytes: never change or reuse one.
enum class RngStream : std::uint32_t {
  range = 1,
  bearing = 2,
  dropout = 3,
  spurious = 4,
  mixed_pixel = 5,
  odometry = 6,
  pose = 7,
  resampling = 8,
  tilt = 9,
};

class CounterRng {
 public:
  CounterRng(std::uint64_t seed, RngStream stream, std::uint32_t frame = 0, std::uint32_t beam = 0);

  std::uint32_t bits();
  /// Uniform in the open interval (0, 1), 52 random bits.
  double uniform();
  /// Standard normal by Box-Muller with the project's own log, sin and cos. Uses two uniforms for two numbers.
  double normal();

 private:
  void refill();

  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 4> block_{};
  int used_ = 4;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace scanbench
