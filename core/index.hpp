// Beams, labels, frames and counts are int; containers count in std::size_t.
#pragma once

#include <concepts>
#include <cstddef>

namespace scanbench {

/// A whole number that is not negative, as an index or a size of a container. Not checked: it is used in inner loops.
template <std::integral Whole>
constexpr std::size_t as_index(Whole i) {
  return static_cast<std::size_t>(i);
}

}  // namespace scanbench
