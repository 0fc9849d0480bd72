// Formats numbers of bytes with binary prefixes.
#include "harness/io/files/size_text.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

namespace scanbench::io {

std::string size_text(double bytes) {
  static constexpr std::array<const char*, 6> kUnits = {"B", "KiB", "MiB", "GiB", "TiB", "PiB"};
  std::size_t unit = 0;
  while (bytes >= 1024.0 && unit + 1 < kUnits.size()) {
    bytes /= 1024.0;
    ++unit;
  }
  return bytes == std::floor(bytes) ? fmt::format("{:.0f} {}", bytes, kUnits[unit])
                                    : fmt::format("{:.1f} {}", bytes, kUnits[unit]);
}

}  // namespace scanbench::io
