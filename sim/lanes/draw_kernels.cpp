// Draws random numbers in lanes: Philox4x32-10 (Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC 2011)
// and Box-Muller.
#include "sim/lanes/draw_kernels.hpp"

#include "core/lanes/elementary.hpp"
#include "core/lanes/lanes.hpp"

namespace scanbench::sim::SCANBENCH_ISA {
namespace {

constexpr unsigned long long kLow = 0xffffffffULL;

Words load_beams(const std::uint32_t* beams) {
  return __builtin_convertvector(load<Lanes<std::uint32_t, kLanes>>(beams), Words);
}

/// Four random words per lane, each in the low half; the high halves are unused.
struct Block {
  Words word[4];
};

/// Philox4x32-10 for one seed, stream and frame: the first block of a beam's counter (0, beam, frame, stream).
class Philox {
 public:
  // NOLINTNEXTLINE(*-member-init): the loop sets the keys
  explicit Philox(const DrawAddress& address) : frame_(all<Words>(address.frame)), stream_(all<Words>(address.stream)) {
    unsigned long long key0 = address.seed & kLow;
    unsigned long long key1 = address.seed >> 32;
    for (int round = 0; round < kRounds; ++round) {
      key0_[round] = all<Words>(key0);
      key1_[round] = all<Words>(key1);
      key0 = (key0 + 0x9E3779B9) & kLow;
      key1 = (key1 + 0xBB67AE85) & kLow;
    }
  }

  // The high halves need no clearing: products read the low halves only.
  Block block(Words beam) const {
    Block c{{Words{}, beam, frame_, stream_}};
    for (int round = 0; round < kRounds; ++round) {
      const Words a = multiply_low_halves(c.word[0], all<Words>(0xD2511F53ULL));
      const Words b = multiply_low_halves(c.word[2], all<Words>(0xCD9E8D57ULL));
      c = {{(b >> 32) ^ c.word[1] ^ key0_[round], b, (a >> 32) ^ c.word[3] ^ key1_[round], a}};
    }
    return c;
  }

 private:
  static constexpr int kRounds = 10;
  Words frame_, stream_;
  Words key0_[kRounds], key1_[kRounds];
};

// 52 bits and a half: the open interval (0, 1).
Doubles uniform(Words high, Words low) {
  return (to_double(((high << 32) | (low & kLow)) >> 12) + 0.5) * 0x1p-52;
}

void uniforms(const DrawAddress& address, int count, double* out) {
  const Philox philox(address);
  for (int i = 0; i < count; i += kLanes) {
    const Block block = philox.block(load_beams(address.beams + i));
    store(out + i, uniform(block.word[0], block.word[1]));
  }
}

// Makes three passes over short stretches. Each pass is so short a chain of operations that a processor overlaps
// several groups.
void normals(const DrawAddress& address, int count, double* out) {
  constexpr int kStretch = 128;
  const Philox philox(address);
  for (int first = 0; first < count; first += kStretch) {
    const int n = count - first < kStretch ? count - first : kStretch;
    double u[kStretch];
    double v[kStretch];
    for (int i = 0; i < n; i += kLanes) {
      const Block block = philox.block(load_beams(address.beams + first + i));
      store(u + i, uniform(block.word[0], block.word[1]));
      store(v + i, uniform(block.word[2], block.word[3]));
    }
    for (int i = 0; i < n; i += kLanes) store(u + i, sqrt(-2.0 * log(load(u + i))));
    for (int i = 0; i < n; i += kLanes) store(out + first + i, load(u + i) * cos(6.28318530717958647693 * load(v + i)));
  }
}

}  // namespace

extern const DrawKernels kDrawKernels;  // NOLINT(readability-redundant-declaration): gives it a name outside
const DrawKernels kDrawKernels{.uniforms = uniforms, .normals = normals};

}  // namespace scanbench::sim::SCANBENCH_ISA
