// Computes quantiles with Boost.Math, in one file because its headers are slow to compile.
#include "metrics/chi_square.hpp"

#include <boost/math/distributions/chi_squared.hpp>

#include "core/error.hpp"

namespace scanbench::metrics {

double chi_square_quantile(double p, std::int64_t pairs) {
  SCANBENCH_ASSERT(p > 0 && p < 1 && pairs >= 1);
  const boost::math::chi_squared distribution(2.0 * static_cast<double>(pairs));
  return boost::math::quantile(distribution, p);
}

}  // namespace scanbench::metrics
