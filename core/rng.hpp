// Counter-based random numbers: Philox4x32-10 (Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC 2011).
//
// A draw depends only on its address (seed, stream, frame, beam) and on the number of earlier draws from that address,
// so the bytes do not depend on the number of threads or the order of work. The name of an algorithm is never part of
// an address, so all algorithms of a comparison see the same noise.
#pragma once

#include <array>
#include <cstdint>

namespace scanbench {

/// The purpose of a draw. The numbers determine the bytes of recordings: never change or reuse one.
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
