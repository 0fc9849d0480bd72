// Quantiles of the chi-square distribution with an even number of degrees of freedom.
#pragma once

#include <cstdint>

namespace scanbench::metrics {

/// x such that a sum of squares of 2 * pairs standard normals is below it with probability p; pairs >= 1, 0 < p < 1.
double chi_square_quantile(double p, std::int64_t pairs);

}  // namespace scanbench::metrics
