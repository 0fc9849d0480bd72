// Sums over the readings at the ends of a line, and the line refitted without them. docs/algorithms/optimal.md, section
// 5.
#include "algorithms/extract/optimal/line_tail.hpp"

#include <Eigen/LU>

#include "core/index.hpp"

namespace scanbench::extract {

const BeamReading& reading_from_end(std::span<const BeamReading> readings, End end, std::size_t k) {
  return end == End::last ? readings[readings.size() - 1 - k] : readings[k];
}

Tails tails_of(const BeamLine& fit, std::span<const BeamReading> readings, const SensorNoise& noise, End end,
               int longest) {
  Tails tails(as_index(longest) + 1);
  for (std::size_t j = 1; j <= as_index(longest); ++j) {
    const BeamReading& b = reading_from_end(readings, end, j - 1);
    const double r = fit.range(b.direction);
    const double s = reading_sigma(noise, r, r * r * cross(fit.theta, b.direction));
    const double error = (b.range_m - r) / s;
    const Vec2 g = -(r * r / s) * b.direction;  // derivative of the range by theta
    tails[j] = tails[j - 1] + Tail{g * g.transpose(), error * g, 0.5 * error * error};
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
