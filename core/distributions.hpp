// Quantiles and probabilities of the normal, Student, chi-square and binomial distributions. Boost.Math computes them.
#pragma once

namespace scanbench {

/// x such that a standard normal value is below it with probability p; 0 < p < 1.
double normal_quantile(double p);
/// Probability that a standard normal value is below x.
double normal_probability(double x);
/// Probability that the absolute value of a standard normal value is at least |x|.
double normal_two_sided(double x);

/// x such that a value of Student's t with `freedom` > 0 degrees of freedom is below it with probability p; 0 < p < 1.
double student_quantile(double p, double freedom);
/// Probability that the absolute value of Student's t is at least |t|.
double student_two_sided(double t, double freedom);

/// x such that the sum of squares of `freedom` standard normal values is below it with probability p; 0 < p < 1.
double chi_square_quantile(double p, double freedom);
/// Probability that such a sum is at least x >= 0, and the x of such a probability; 0 < p < 1. Both keep their digits
/// for probabilities near 0.
double chi_square_upper(double x, double freedom);
double chi_square_upper_quantile(double p, double freedom);

/// Ends of the interval of Clopper and Pearson for a share, from the number of trials and of successes: the share below
/// or above which the observed number has a probability of `tail`. 0 and 1 where the interval is open.
double share_lower_bound(double trials, double successes, double tail);
double share_upper_bound(double trials, double successes, double tail);

}  // namespace scanbench
