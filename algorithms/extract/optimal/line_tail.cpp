// Sums over the readings at the ends of a line, and the line refitted without them. docs/algorithms/optimal.md, section
// 5.
#include "algorithms/extract/optimal/line_tail.hpp"

#include <Eigen/LU>

#include "core/index.hpp"

namespace scanbench::extract {

const BeamReading& reading_from_end(std::span<const BeamReading> readings, End end, std::size_t k) {
  return end == End::last ? readings[readings.size() - 1 - k] : readings[k];
}

Tail tail_of(const BeamLine& fit, const BeamReading& reading, double r, const ReadingNoise& noise) {
  // The derivative of the range by theta is -r^2 times the direction d.
  const Vec2& d = reading.direction;
  const double r2 = r * r;
  const double inverse_variance = 1.0 / noise.variance(r, r2 * cross(fit.theta, d));
  const double error = reading.range_m - r;
  Tail tail;
  tail.information = (r2 * r2 * inverse_variance) * (d * d.transpose());
  tail.gradient = (-r2 * inverse_variance * error) * d;
  tail.half_squares = 0.5 * error * error * inverse_variance;
  return tail;
}

Tails tails_of(const BeamLine& fit, std::span<const BeamReading> readings, const ReadingNoise& noise, End end,
               int longest) {
  Tails tails;
  for (std::size_t j = 1; j <= as_index(longest); ++j) {
    const BeamReading& b = reading_from_end(readings, end, j - 1);
    tails[j] = tails[j - 1] + tail_of(fit, b, fit.range(b.direction), noise);
  }
  return tails;
}

// With N the remaining information, the best line without the tail is at theta - N^-1 gradient, and half the sum of
// squares falls by gradient' N^-1 gradient / 2 in addition to the squares of the tail.
Shortened without_tail(const BeamLine& fit, const Tail& tail) {
  const Eigen::Matrix2d left = fit.information - tail.information;
  if (!(left.determinant() > 1e-9 * fit.information.determinant())) return {};
  const Eigen::Matrix2d covariance = left.inverse();
  const Vec2 step = -(covariance * tail.gradient);
  return {fit.theta + step, covariance, tail.half_squares - 0.5 * tail.gradient.dot(step), true};
}

Tail operator+(const Tail& a, const Tail& b) {
  return {a.information + b.information, a.gradient + b.gradient, a.half_squares + b.half_squares};
}

}  // namespace scanbench::extract
