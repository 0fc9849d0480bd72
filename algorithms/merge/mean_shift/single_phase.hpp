// Both phases of mean-shift merging at once (Lakaemper 2009, remark at the end of section IV.C).
#pragma once

#include <span>

#include "algorithms/merge/mean_shift/phases.hpp"

namespace scanbench::merge {

/// Each point climbs under its own kernel: K2 in the segment's own direction times K1 in the angle.
Clustering cluster_in_one_phase(std::span<const Piece> pieces, const Kernels& kernels, bool with_paths);

}  // namespace scanbench::merge
