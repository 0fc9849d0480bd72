// A small line chart inside a line of text.
#pragma once

#include <span>
#include <string>

namespace scanbench::results {

/// Inline SVG of 120 x 24 px: one point per value, joined where neighbours are defined, the last one marked, in the
/// colour of the text. The smallest and the largest value span the height. NaN values are gaps. `label` is what a
/// screen reader says.
std::string sparkline(std::span<const double> values, const std::string& label);

}  // namespace scanbench::results
