// Draws Philox blocks, uniform numbers and normal numbers.
#include "core/rng.hpp"

#include <cmath>

#include <Random123/philox.h>

#include "core/geometry/angles.hpp"
#include "core/geometry/portable_math.hpp"
#include "core/index.hpp"

namespace scanbench {

CounterRng::CounterRng(std::uint64_t seed, RngStream stream, std::uint32_t frame, std::uint32_t beam)
    : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
      counter_{0, beam, frame, static_cast<std::uint32_t>(stream)} {}

void CounterRng::refill() {
  const r123::Philox4x32::ctr_type counter{{counter_[0], counter_[1], counter_[2], counter_[3]}};
  const r123::Philox4x32::ukey_type key{{key_[0], key_[1]}};
  const auto out = r123::Philox4x32{}(counter, key);
  for (std::size_t i = 0; i < 4; ++i) block_[i] = out[i];
  ++counter_[0];
  used_ = 0;
}

std::uint32_t CounterRng::bits() {
  if (used_ == 4) refill();
  return block_[as_index(used_++)];
}

double CounterRng::uniform() {
  const std::uint64_t high = bits();
  const std::uint64_t low = bits();
  const std::uint64_t mantissa = ((high << 32) | low) >> 12;  // 52 bits; + 1/2 keeps 0 and 1 out
  return (static_cast<double>(mantissa) + 0.5) * 0x1p-52;
}

double CounterRng::normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  const double radius = std::sqrt(-2.0 * portable::log(uniform()));
  const auto [s, c] = portable::sincos(kTwoPi * uniform());
  spare_ = radius * s;
  has_spare_ = true;
  return radius * c;
}

}  // namespace scanbench
