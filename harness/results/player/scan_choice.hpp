// Which scans of a long recording a page can hold.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace scanbench::results {

/// All scans if there are at most `most`; else half of the places for those with the largest errors, and an even
/// selection of the others. `errors`: one per scan; NaN counts as the smallest. In ascending order.
std::vector<std::size_t> choose_scans(std::span<const double> errors, std::size_t most);

}  // namespace scanbench::results
