// With 2n degrees of freedom the chi-square distribution is a Poisson sum: P(X > x) = P(Poisson(x/2) < n) (Abramowitz
// & Stegun, 26.4.21).
#include "metrics/chi_square.hpp"

#include <cmath>

#include "core/error.hpp"

namespace scanbench::metrics {
namespace {

/// P(Poisson(mean) < n), summed away from the largest term so that the sum ends after a few standard deviations.
double poisson_below(double mean, double n) {
  const auto term = [&](double k) { return std::exp(k * std::log(mean) - mean - std::lgamma(k + 1)); };
  constexpr double kNegligible = 1e-17;
  double sum = 0.0;
  if (n <= mean) {
    double t = term(n - 1);
    for (double k = n - 1; k >= 0 && t > kNegligible * sum; t *= k / mean, --k) sum += t;
    return sum;
  }
  double t = term(n);
  for (double k = n; t > kNegligible * sum; ++k, t *= mean / k) sum += t;
  return 1.0 - sum;
}

}  // namespace

double chi_square_quantile(double p, std::int64_t pairs) {
  SCANBENCH_ASSERT(p > 0 && p < 1 && pairs >= 1);
  const auto n = static_cast<double>(pairs);
  double low = 0.0;
  double high = n + 1;
  while (1.0 - poisson_below(high, n) < p) high *= 2;
  while (high - low > 1e-10 * high) {
    const double middle = 0.5 * (low + high);
    (1.0 - poisson_below(middle, n) < p ? low : high) = middle;
  }
  return low + high;  // twice the mean of the Poisson distribution
}

}  // namespace scanbench::metrics
