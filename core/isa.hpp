// Selects the build of the kernels (scanbench_kernels in cmake/targets.cmake) that this processor can run.
#pragma once

namespace scanbench {

enum class Isa {
  baseline,  ///< any x86-64
  v3,        ///< AVX2, as in x86-64-v3
};

/// The best that the processor has. Both give equal bytes.
Isa best_isa();

}  // namespace scanbench
