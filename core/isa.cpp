// Detects the processor's instruction set.
#include "core/isa.hpp"

namespace scanbench {

Isa best_isa() {
  static const Isa best = __builtin_cpu_supports("avx2") ? Isa::v3 : Isa::baseline;
  return best;
}

}  // namespace scanbench
