// Distributions by Boost.Math.
#include "core/distributions.hpp"

#include <cmath>

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace scanbench {

namespace math = boost::math;

double normal_quantile(double p) {
  return math::quantile(math::normal(), p);
}

double normal_probability(double x) {
  return math::cdf(math::normal(), x);
}

double normal_two_sided(double x) {
  return 2.0 * math::cdf(math::complement(math::normal(), std::fabs(x)));
}

double student_quantile(double p, double freedom) {
  return math::quantile(math::students_t(freedom), p);
}

double student_two_sided(double t, double freedom) {
  return 2.0 * math::cdf(math::complement(math::students_t(freedom), std::fabs(t)));
}

double chi_square_quantile(double p, double freedom) {
  return math::quantile(math::chi_squared(freedom), p);
}

double chi_square_upper(double x, double freedom) {
  return math::cdf(math::complement(math::chi_squared(freedom), x));
}

double chi_square_upper_quantile(double p, double freedom) {
  return math::quantile(math::complement(math::chi_squared(freedom), p));
}

double share_lower_bound(double trials, double successes, double tail) {
  return successes <= 0.0 ? 0.0 : math::binomial::find_lower_bound_on_p(trials, successes, tail);
}

double share_upper_bound(double trials, double successes, double tail) {
  return successes >= trials ? 1.0 : math::binomial::find_upper_bound_on_p(trials, successes, tail);
}

}  // namespace scanbench
