// docs/algorithms/optimal.md, section 5.
#include "algorithms/extract/line_ends.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace scanbench::extract {
namespace {

constexpr int kMostForeign = 6;

// What the last readings of an end, j of them, take with them when they are not the line's.
struct Tail {
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Vec2 pull = Vec2::Zero();  ///< of the readings on theta: sum of g e / s^2 in the linear model
  double half_squares = 0.0;
  double log_density = 0.0;  ///< of the readings as foreign ones over that of a normal error of 0
};

// Log density of a reading drawn uniformly between two ranges, with a normal error, over sigma sqrt(2 pi).
double log_density_between(double z, double a, double b, double sigma) {
  const auto [low, high] = std::minmax(a, b);
  const double width = (high - low) / sigma;
  if (width < 1e-3) return -0.5 * std::pow((z - low) / sigma, 2);
  const double x = (z - low) / sigma, y = (z - high) / sigma;
  // Far outside both terms vanish: the log of the nearer tail is then as good.
  const double outside = std::max({-x, y, 0.0});
  if (outside > 6.0) return -0.5 * outside * outside - std::log(width * outside);
  const double probability = 0.5 * (std::erfc(-x / std::sqrt(2.0)) - std::erfc(-y / std::sqrt(2.0)));
  return std::log(std::max(probability, 1e-12) * std::sqrt(kTwoPi) / width);
}

std::array<Tail, kMostForeign + 1> tails_of(const BeamLine& fit, std::span<const BeamReading> readings,
                                            const SensorNoise& noise, const Beyond& beyond, bool last, int most) {
  std::array<Tail, kMostForeign + 1> tails;
  for (int j = 1; j <= most; ++j) {
    const std::size_t k = static_cast<std::size_t>(j) - 1;
    const BeamReading& b = last ? readings[readings.size() - 1 - k] : readings[k];
    const double r = fit.range(b.direction);
    const double s = reading_sigma(noise, r, r * r * cross(fit.theta, b.direction));
    const double error = (b.range_m - r) / s;
    const Vec2 g = -(r * r / s) * b.direction;  // of the range by theta
    Tail& t = tails[static_cast<std::size_t>(j)];
    t = tails[static_cast<std::size_t>(j) - 1];
    t.information += g * g.transpose();
    t.pull += error * g;
    t.half_squares += 0.5 * error * error;
    const double other = beyond.range(b.direction);
    t.log_density += other > 0 ? log_density_between(b.range_m, r, other, s) - std::log(2.0) : -1e3;
  }
  return tails;
}

}  // namespace

UncertainLine with_uncertain_ends(const BeamLine& fit, std::span<const BeamReading> readings, const SensorNoise& noise,
                                  const std::array<std::optional<Beyond>, 2>& beyond, int min_readings) {
  UncertainLine result{.line = fit, .foreign = {}};
  std::array<std::array<Tail, kMostForeign + 1>, 2> tails;
  std::array<int, 2> most{};
  const int spare = static_cast<int>(readings.size()) - min_readings;
  for (std::size_t end = 0; end < 2; ++end) {
    if (!beyond[end]) continue;
    most[end] = std::clamp(spare / 2, 0, kMostForeign);
    tails[end] = tails_of(fit, readings, noise, *beyond[end], end == 1, most[end]);
  }
  if (most[0] + most[1] == 0) return result;

  // Without the tails the best line moves by -N^-1 pull, N the information that is left, and half the squares that
  // are left fall by pull' N^-1 pull / 2 more than those of the tails.
  double total = 0.0, best = -1.0;
  Vec2 mean = Vec2::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  for (int i = 0; i <= most[0]; ++i)
    for (int j = 0; j <= most[1]; ++j) {
      const Tail& a = tails[0][static_cast<std::size_t>(i)];
      const Tail& b = tails[1][static_cast<std::size_t>(j)];
      const Eigen::Matrix2d left = fit.information - a.information - b.information;
      const double det = left.determinant();
      if (!(det > 1e-9 * fit.information.determinant())) continue;
      const Eigen::Matrix2d covariance = left.inverse();
      const Vec2 pull = a.pull + b.pull;
      const Vec2 step = -(covariance * pull);
      const double log_weight = a.half_squares + b.half_squares - 0.5 * pull.dot(step) + a.log_density + b.log_density;
      const double weight = std::exp(std::min(log_weight, 100.0));
      total += weight;
      mean += weight * step;
      second += weight * (covariance + step * step.transpose());
      if (weight > best) {
        best = weight;
        result.foreign = {i, j};
      }
    }
  mean /= total;
  result.line.theta = fit.theta + mean;
  result.line.information = (second / total - mean * mean.transpose()).inverse();
  return result;
}

}  // namespace scanbench::extract
