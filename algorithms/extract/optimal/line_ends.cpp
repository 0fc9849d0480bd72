// Computes densities of foreign readings, and the average over hypotheses. docs/algorithms/optimal.md, section 5.
#include "algorithms/extract/optimal/line_ends.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "core/index.hpp"

namespace scanbench::extract {
namespace {

constexpr double kLargestGain = 100.0;  // its exponential does not overflow

int longest_tail(std::span<const BeamReading> readings, int min_readings) {
  return std::clamp((static_cast<int>(readings.size()) - min_readings) / 2, 0, kLongestTail);
}

// Density of a reading that is uniform between two ranges plus a normal error, times sigma sqrt(2 pi).
double density_between(double z, double a, double b, double sigma) {
  const auto [low, high] = std::minmax(a, b);
  const double width = (high - low) / sigma;
  const double x = (z - low) / sigma, y = (z - high) / sigma;
  if (width < 1e-3) return std::exp(-0.5 * x * x);
  const double probability = 0.5 * (std::erfc(-x / std::sqrt(2.0)) - std::erfc(-y / std::sqrt(2.0)));
  return std::max(probability, 1e-12) * std::sqrt(kTwoPi) / width;
}

// Foreign readings anywhere between the line and the next range.
void weigh_towards_range(const BeamLine& fit, std::span<const BeamReading> readings, const SensorNoise& noise,
                         double range_m, End end, UncertainEnd& open) {
  for (std::size_t j = 1; j <= as_index(open.longest); ++j) {
    const BeamReading& b = reading_from_end(readings, end, j - 1);
    const double r = fit.range(b.direction);
    const double s = reading_sigma(noise, r, r * r * cross(fit.theta, b.direction));
    open.without_side[j] = open.without_side[j - 1] * 0.5 * density_between(b.range_m, r, range_m, s);
  }
}

// The last readings of a line and the first readings of the next.
class Junction {
 public:
  Junction(std::span<const BeamReading> line, End end, std::span<const BeamReading> next, int of_line, int of_next,
           const SensorNoise& noise) {
    for (int k = of_line; k >= 0; --k) add(reading_from_end(line, end, as_index(k)), noise);
    next_begins_ = size_;
    const End near = end == End::last ? End::first : End::last;
    for (int k = 0; k <= of_next; ++k) add(reading_from_end(next, near, as_index(k)), noise);
    for (std::size_t k = 1; k < size_; ++k)
      between_[k] = (readings_[k - 1].direction + readings_[k].direction).normalized();
  }

  // Density of the last i readings of line a and the first j of the next line b on a straight side from a to b, divided
  // by that of normal errors of 0. The side begins and ends anywhere between two beams. With h the change of its range
  // per beam, this adds the variance ((1 - t)^2 + t^2) h^2 / 12 at a fraction t of its length. A reading far from the
  // side is uniform within its own range.
  double density_on_side(const Vec2& a, const Vec2& b, std::size_t i, std::size_t j) const {
    const std::size_t first = next_begins_ - i, last = next_begins_ + j;
    const double to_a = a.dot(between_[first]), to_b = b.dot(between_[last]);
    if (!(to_a > 0 && to_b > 0)) return 0.0;
    const Vec2 p = between_[first] / to_a;
    const Vec2 side = between_[last] / to_b - p;
    const double from_p = cross(p, side);
    const auto beams = static_cast<double>(last - first);
    const double h = (1.0 / to_b - 1.0 / to_a) / beams;
    double density = 1.0;
    for (std::size_t k = first; k < last; ++k) {
      const double s = sigma_[k];
      const double z = readings_[k].range_m;
      const double r = from_p / cross(readings_[k].direction, side);
      const double t = (static_cast<double>(k - first) + 0.5) / beams;
      const double variance = s * s + ((1 - t) * (1 - t) + t * t) * h * h / 12.0;
      const double squared = (z - r) * (z - r) / variance;
      density *= std::max(std::exp(-0.5 * squared) * s / std::sqrt(variance), s * std::sqrt(kTwoPi) / z);
    }
    return density;
  }

 private:
  void add(const BeamReading& reading, const SensorNoise& noise) {
    sigma_[size_] = reading_sigma(noise, reading.range_m, 0.0);
    readings_[size_++] = reading;
  }

  static constexpr std::size_t kMost = 2 * kLongestTail + 2;
  std::array<BeamReading, kMost> readings_;
  std::array<double, kMost> sigma_{};
  std::array<Vec2, kMost> between_;  // directions between a reading and the one before
  std::size_t size_ = 0;
  std::size_t next_begins_ = 0;
};

// Foreign readings on a straight side that joins the line with the next one, summed over the number of readings of the
// next line that are on the side as well.
void weigh_towards_line(const BeamLine& fit, std::span<const BeamReading> readings, const SensorNoise& noise,
                        const Adjacent& adjacent, End end, int min_readings, UncertainEnd& open) {
  const int longest = longest_tail(adjacent.readings, min_readings);
  const Tails theirs =
      tails_of(*adjacent.line, adjacent.readings, noise, end == End::last ? End::first : End::last, longest);
  std::array<Shortened, kLongestTail + 1> next;
  for (std::size_t j = 0; j <= as_index(longest); ++j) next[j] = without_tail(*adjacent.line, theirs[j]);
  const Junction junction(readings, end, adjacent.readings, open.longest, longest, noise);
  const double cuts = (open.longest + 1.0) * (longest + 1.0) - 1.0;
  for (std::size_t i = 0; i <= as_index(open.longest); ++i) {
    const Shortened line = without_tail(fit, open.tails[i]);
    for (std::size_t j = 0; line.valid && j <= as_index(longest); ++j) {
      if (i + j == 0 || !next[j].valid) continue;
      open.with_side[i] += std::exp(std::min(next[j].gain, kLargestGain)) / cuts *
                           junction.density_on_side(line.theta, next[j].theta, i, j);
    }
  }
}

}  // namespace

UncertainEnds::UncertainEnds(const BeamLine& fit, std::span<const BeamReading> readings, const SensorNoise& noise,
                             const std::array<std::optional<Adjacent>, 2>& adjacent, int min_readings)
    : fit_(fit) {
  for (const End end : {End::first, End::last}) {
    const auto k = static_cast<std::size_t>(end);
    if (!adjacent[k]) continue;
    UncertainEnd& open = open_[k];
    open.longest = longest_tail(readings, min_readings);
    open.tails = tails_of(fit, readings, noise, end, open.longest);
    if (adjacent[k]->line)
      weigh_towards_line(fit, readings, noise, *adjacent[k], end, min_readings, open);
    else
      weigh_towards_range(fit, readings, noise, adjacent[k]->range_m, end, open);
  }
}

UncertainLine UncertainEnds::average(double side_probability) const {
  UncertainLine result{.line = fit_, .foreign = {}, .side = {}};
  if (open_[0].longest + open_[1].longest == 0) return result;
  const double odds = side_probability / (1.0 - side_probability);
  const auto density = [&](std::size_t end, std::size_t i) {
    return odds * open_[end].with_side[i] + open_[end].without_side[i];
  };
  double total = 0.0;
  Vec2 mean = Vec2::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  std::array<std::array<double, kLongestTail + 1>, 2> weights{};  // per end, by number of foreign readings
  for (std::size_t i = 0; i <= as_index(open_[0].longest); ++i)
    for (std::size_t j = 0; j <= as_index(open_[1].longest); ++j) {
      const Shortened line = without_tail(fit_, open_[0].tails[i] + open_[1].tails[j]);
      if (!line.valid) continue;
      const double weight = std::exp(std::min(line.gain, kLargestGain)) * density(0, i) * density(1, j);
      const Vec2 step = line.theta - fit_.theta;
      total += weight;
      mean += weight * step;
      second += weight * (line.covariance + step * step.transpose());
      weights[0][i] += weight;
      weights[1][j] += weight;
    }
  mean /= total;
  result.line.theta = fit_.theta + mean;
  result.line.information = (second / total - mean * mean.transpose()).inverse();
  for (std::size_t end = 0; end < 2; ++end) {
    for (std::size_t i = 0; i <= as_index(open_[end].longest); ++i)
      if (weights[end][i] > 0)
        result.side[end] += weights[end][i] / total * odds * open_[end].with_side[i] / density(end, i);
    double up_to = weights[end][0];
    while (up_to < 0.5 * total) up_to += weights[end][as_index(++result.foreign[end])];
  }
  return result;
}

}  // namespace scanbench::extract
