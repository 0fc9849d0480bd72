// Bayes factors of breaks, from sums over the readings on both sides. docs/algorithms/optimal.md, section 5.
#include "algorithms/extract/optimal/hidden_break.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/LU>

#include "algorithms/extract/optimal/line_tail.hpp"
#include "core/index.hpp"

namespace scanbench::extract {
namespace {

constexpr double kLargestGain = 100.0;  // its exponential does not overflow

// The inverse of a symmetric matrix with this determinant.
Eigen::Matrix2d inverse(const Eigen::Matrix2d& m, double determinant) {
  const double f = 1.0 / determinant;
  Eigen::Matrix2d result;
  result << f * m(1, 1), -f * m(0, 1), -f * m(0, 1), f * m(0, 0);
  return result;
}

// The point of the line on the beam of a reading, and the sums over all readings up to this one.
struct UpTo {
  Vec2 point;
  Tail sums;
};

std::vector<UpTo> prefix_sums(const BeamLine& fit, std::span<const BeamReading> readings, const ReadingNoise& noise) {
  std::vector<UpTo> result(readings.size());
  Tail sums;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const double r = fit.range(readings[i].direction);
    sums = sums + tail_of(fit, readings[i], r, noise);
    result[i] = {r * readings[i].direction, sums};
  }
  return result;
}

}  // namespace

HiddenBreak::HiddenBreak(const BeamLine& fit, std::span<const BeamReading> readings, const ReadingNoise& noise,
                         int min_readings) {
  const int n = static_cast<int>(readings.size());
  if (n < 2 * min_readings) return;
  const std::vector<UpTo> up_to = prefix_sums(fit, readings, noise);
  // Not fit.information: it is that of the step before the last one, and noise may jump at a range.
  const Eigen::Matrix2d all = up_to.back().sums.information;
  const double all_determinant = all.determinant();
  const Eigen::Matrix2d whole = inverse(all, all_determinant);
  for (int first = min_readings; first <= n - min_readings; ++first) {
    const UpTo& before = up_to[as_index(first - 1)];
    const Eigen::Matrix2d& ahead = before.sums.information;
    const Vec2& gradient = before.sums.gradient;
    const Eigen::Matrix2d behind = all - ahead;
    const double ahead_determinant = ahead.determinant(), behind_determinant = behind.determinant();
    if (!(ahead_determinant > 1e-9 * all_determinant) || !(behind_determinant > 1e-9 * all_determinant)) continue;
    const bool longer_first = (before.point - up_to.front().point).squaredNorm() >=
                              (up_to.back().point - up_to[as_index(first)].point).squaredNorm();
    const Eigen::Matrix2d a = inverse(ahead, ahead_determinant), b = inverse(behind, behind_determinant);
    // The lines of the parts are theta + a g and theta - b g.
    const Vec2 to_first = a * gradient, to_second = b * gradient;
    const double gain = 0.5 * gradient.dot(to_first + to_second);
    const double width = static_cast<double>(first) * (n - first) / n;
    const double share = width / (1.0 + width);
    const double weight = std::exp(std::min(share * gain, kLargestGain)) / (1.0 + width);
    const Vec2 step = share * (longer_first ? to_first : Vec2(-to_second));
    ++places_;
    bayes_factor_ += weight;
    step_ += weight * step;
    second_ += weight * (share * ((longer_first ? a : b) - whole) + step * step.transpose());
  }
  if (places_ == 0) return;
  bayes_factor_ /= places_;
  step_ /= places_;
  second_ /= places_;
}

double HiddenBreak::probability(double prior) const {
  const double broken = prior * bayes_factor_;
  return broken / (1.0 - prior + broken);
}

BeamLine HiddenBreak::average(const BeamLine& line, double prior) const {
  if (!possible()) return line;
  const double share = probability(prior) / bayes_factor_;
  const Vec2 mean = share * step_;
  const Eigen::Matrix2d second = share * second_;
  BeamLine result;
  result.theta = line.theta + mean;
  result.information = (line.information.inverse() + second - mean * mean.transpose()).inverse();
  return result;
}

}  // namespace scanbench::extract
