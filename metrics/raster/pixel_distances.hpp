// Distances between two sets of pixels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/contracts/line_raster.hpp"

namespace scanbench::metrics {

/// Per pixel of `from` the squared Euclidean distance to the nearest pixel of `to`, in pixels: the exact distance
/// transform of `to`, at the pixels of `from` only. Both sets are in order, each pixel once. Empty if one of them is.
std::vector<std::int64_t> squared_distances(std::span<const Pixel> from, std::span<const Pixel> to);

}  // namespace scanbench::metrics
