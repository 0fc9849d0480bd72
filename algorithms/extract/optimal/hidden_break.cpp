// Bayes factors of breaks, from sums over the readings on both sides. docs/algorithms/optimal.md, section 5.
#include "algorithms/extract/optimal/hidden_break.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "algorithms/extract/optimal/line_tail.hpp"
#include "core/index.hpp"

namespace scanbench::extract {
namespace {

constexpr double kLargestGain = 100.0;  // its exponential does not overflow

}  // namespace

HiddenBreak::HiddenBreak(const BeamLine& fit, std::span<const BeamReading> readings, const SensorNoise& noise,
                         int min_readings) {
  const int n = static_cast<int>(readings.size());
  if (n < 2 * min_readings) return;
  const Tails sums = tails_of(fit, readings, noise, End::first, n);
  // Not fit.information: it is that of the step before the last one, and noise may jump at a range.
  const Eigen::Matrix2d all = sums.back().information;
  const Eigen::Matrix2d whole = all.inverse();
  const auto point = [&](int i) {
    const Vec2& d = readings[as_index(i)].direction;
    return Vec2(fit.range(d) * d);
  };
  for (int first = min_readings; first <= n - min_readings; ++first) {
    const Tail& before = sums[as_index(first)];
    const Eigen::Matrix2d behind = all - before.information;
    if (!(before.information.determinant() > 1e-9 * all.determinant()) ||
        !(behind.determinant() > 1e-9 * all.determinant()))
      continue;
    const bool longer_first = (point(first - 1) - point(0)).norm() >= (point(n - 1) - point(first)).norm();
    const Eigen::Matrix2d a = before.information.inverse(), b = behind.inverse();
    // The lines of the parts are theta + a g and theta - b g.
    const double gain = 0.5 * before.gradient.dot((a + b) * before.gradient);
    const double width = static_cast<double>(first) * (n - first) / n;
    const double share = width / (1.0 + width);
    Place place;
    place.weight = std::exp(std::min(share * gain, kLargestGain)) / (1.0 + width);
    place.step = share * (longer_first ? Vec2(a * before.gradient) : Vec2(-(b * before.gradient)));
    place.covariance = share * ((longer_first ? a : b) - whole);
    places_.push_back(place);
  }
  for (Place& place : places_) {
    place.weight /= static_cast<double>(places_.size());
    bayes_factor_ += place.weight;
  }
}

double HiddenBreak::probability(double prior) const {
  const double broken = prior * bayes_factor_;
  return broken / (1.0 - prior + broken);
}

BeamLine HiddenBreak::average(const BeamLine& line, double prior) const {
  if (!possible()) return line;
  const double share = probability(prior) / bayes_factor_;
  Vec2 mean = Vec2::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  for (const Place& place : places_) {
    mean += share * place.weight * place.step;
    second += share * place.weight * (place.covariance + place.step * place.step.transpose());
  }
  BeamLine result;
  result.theta = line.theta + mean;
  result.information = (line.information.inverse() + second - mean * mean.transpose()).inverse();
  return result;
}

}  // namespace scanbench::extract
