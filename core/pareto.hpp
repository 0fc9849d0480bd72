// The Pareto front of methods that have two costs, for example time and error.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace scanbench {

/// Indices of the pairs that no other pair beats in one cost and equals or beats in the other, by increasing first
/// cost. Equal pairs are on the front together. A pair with a cost that is NaN is not on the front.
std::vector<std::size_t> pareto_front(std::span<const std::pair<double, double>> costs);

}  // namespace scanbench
