// Selects the build of the kernels (scanbench_kernels in cmake/targets.cmake) that this processor can run.
#pragma once

namespace scanbench {

enum class Isa {
  baseline,  ///< any x86-64
  v3,        ///< AVX2, as in x86-64-v3
};

/// The best that the processor has. All give equal bytes.
Isa best_isa();

/// Of the two builds of a table of kernels, the one for `isa`.
template <class Kernels>
const Kernels& build_for(Isa isa, const Kernels& baseline, const Kernels& v3) {
  return isa == Isa::v3 ? v3 : baseline;
}

}  // namespace scanbench
