// Detects the processor's instruction set.
#include "core/isa.hpp"

#include <algorithm>

namespace scanbench {
namespace {

Isa detect() {
  if (!__builtin_cpu_supports("avx2")) return Isa::baseline;
  const bool is_v4 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                     __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                     __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("popcnt");
  return is_v4 ? Isa::v4 : Isa::v3;
}

}  // namespace

Isa best_isa(Isa limit) {
  static const Isa best = detect();
  return std::min(best, limit);
}

}  // namespace scanbench
