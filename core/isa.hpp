// Selects the build of the kernels (scanbench_kernels in cmake/targets.cmake) that this processor can run.
#pragma once

namespace scanbench {

enum class Isa {
  baseline,  ///< any x86-64
  v3,        ///< AVX2, as in x86-64-v3
  v4,        ///< AVX-512 F, BW, CD, DQ and VL, as in x86-64-v4
};

/// The best that the processor has, at most `limit`: kernels with a build for AVX-512 pass v4. All give equal bytes.
Isa best_isa(Isa limit = Isa::v3);

/// Of the three builds of a table of kernels, the one for `isa`.
template <class Kernels>
const Kernels& build_for(Isa isa, const Kernels& baseline, const Kernels& v3, const Kernels& v4) {
  return isa == Isa::v4 ? v4 : isa == Isa::v3 ? v3 : baseline;
}

}  // namespace scanbench
