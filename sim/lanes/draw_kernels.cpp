// Draws random numbers in lanes: Philox4x32-10 (Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC 2011)
// and Box-Muller.
#include "sim/lanes/draw_kernels.hpp"

#include "sim/lanes/lanes.hpp"
#include "sim/lanes/portable_lanes.hpp"

namespace scanbench::sim::SCANBENCH_ISA {
namespace {

constexpr unsigned long long kLow = 0xffffffffULL;

WideWords every_word(unsigned long long value) {
  return value - WideWords{};
}

typedef std::uint32_t Halves __attribute__((vector_size(4 * kWideLanes), aligned(4), may_alias));  // NOLINT

WideWords load_beams(const std::uint32_t* beams) {
  return __builtin_convertvector(*reinterpret_cast<const Halves*>(beams), WideWords);
}

/// Four random words per lane, each in the low half; the high halves are unused.
struct Block {
  WideWords word[4];
};

/// Philox4x32-10 for one seed, stream and frame: the first block of a beam's counter (0, beam, frame, stream).
class Philox {
 public:
  // NOLINTNEXTLINE(*-member-init): the loop sets the keys
  explicit Philox(const DrawAddress& address) : frame_(every_word(address.frame)), stream_(every_word(address.stream)) {
    unsigned long long key0 = address.seed & kLow;
    unsigned long long key1 = address.seed >> 32;
    for (int round = 0; round < kRounds; ++round) {
      key0_[round] = every_word(key0);
      key1_[round] = every_word(key1);
      key0 = (key0 + 0x9E3779B9) & kLow;
      key1 = (key1 + 0xBB67AE85) & kLow;
    }
  }

  // The high halves need no clearing: products read the low halves only.
  Block block(WideWords beam) const {
    Block c{{every_word(0), beam, frame_, stream_}};
    for (int round = 0; round < kRounds; ++round) {
      const WideWords a = multiply_low_halves(c.word[0], every_word(0xD2511F53));
      const WideWords b = multiply_low_halves(c.word[2], every_word(0xCD9E8D57));
      c = {{(b >> 32) ^ c.word[1] ^ key0_[round], b, (a >> 32) ^ c.word[3] ^ key1_[round], a}};
    }
    return c;
  }

 private:
  static constexpr int kRounds = 10;
  WideWords frame_, stream_;
  WideWords key0_[kRounds], key1_[kRounds];
};

// 52 bits and a half: the open interval (0, 1).
WideDoubles uniform(WideWords high, WideWords low) {
  return (to_double(((high << 32) | (low & kLow)) >> 12) + 0.5) * 0x1p-52;
}

void uniforms(const DrawAddress& address, int count, double* out) {
  const Philox philox(address);
  for (int i = 0; i < count; i += kWideLanes) {
    const Block block = philox.block(load_beams(address.beams + i));
    store_wide(out + i, uniform(block.word[0], block.word[1]));
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
    for (int i = 0; i < n; i += kWideLanes) {
      const Block block = philox.block(load_beams(address.beams + first + i));
      store_wide(u + i, uniform(block.word[0], block.word[1]));
      store_wide(v + i, uniform(block.word[2], block.word[3]));
    }
    for (int i = 0; i < n; i += kWideLanes) store_wide(u + i, sqrt(-2.0 * log_lanes(load_wide(u + i))));
    for (int i = 0; i < n; i += kWideLanes)
      store_wide(out + first + i, load_wide(u + i) * cos_lanes(6.28318530717958647693 * load_wide(v + i)));
  }
}

}  // namespace

extern const DrawKernels kDrawKernels;  // NOLINT(readability-redundant-declaration): gives it a name outside
const DrawKernels kDrawKernels{.uniforms = uniforms, .normals = normals};

}  // namespace scanbench::sim::SCANBENCH_ISA
