// Normal and uniform random numbers of several beams at once: the first draws of CounterRng(seed, stream, frame,
// beam), bit for bit.
#pragma once

#include <cstdint>

namespace scanbench::sim {

/// Addresses of some beams of a frame.
struct DrawAddress {
  std::uint64_t seed;
  std::uint32_t stream;
  std::uint32_t frame;
  const std::uint32_t* beams;
};

/// The kernels of random numbers, for one kind of processor. `count` is a multiple of 8; pad the list with any beams.
struct DrawKernels {
  /// Uniform in (0, 1).
  void (*uniforms)(const DrawAddress& address, int count, double* out);
  /// Standard normal.
  void (*normals)(const DrawAddress& address, int count, double* out);
};

namespace baseline {
extern const DrawKernels kDrawKernels;
}
namespace v3 {
extern const DrawKernels kDrawKernels;
}

}  // namespace scanbench::sim
