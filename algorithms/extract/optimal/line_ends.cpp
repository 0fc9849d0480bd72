// Computes densities of foreign readings, and the average over hypotheses. docs/algorithms/optimal.md, section 5.
#include "algorithms/extract/optimal/line_ends.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "core/index.hpp"

namespace scanbench::extract {
namespace {

constexpr double kLargestEndGain = 100.0;  // its exponential does not overflow

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

// The last readings of a line and the first readings of the next.
class Junction {
 public:
  Junction(std::span<const BeamReading> line, std::span<const BeamReading> next, int of_line, int of_next,
           const ReadingNoise& noise) {
    for (int k = of_line; k >= 0; --k) add(reading_from_end(line, End::last, as_index(k)), noise);
    next_begins_ = size_;
    for (int k = 0; k <= of_next; ++k) add(reading_from_end(next, End::first, as_index(k)), noise);
    for (std::size_t k = 1; k < size_; ++k)
      between_[k] = (readings_[k - 1].direction + readings_[k].direction).normalized();
  }

  // Density of the last i readings of line a and the first j of the next line b on a straight side from a to b, divided
  // by that of normal errors of 0. The side begins and ends anywhere between two beams. With h the change of its range
  // per beam, this adds the variance ((1 - t)^2 + t^2) h^2 / 12 at a fraction t of its length. A reading far from the
  // side is uniform within its own range.
  //
  // With e the error of a reading, s^2 its variance and 1 + q the growth of the variance, a reading has the factor
  // exp(-e^2 / (2 s^2 (1 + q))) / sqrt(1 + q), if this is not less than that of a uniform one. The exponents and the
  // 1 + q are collected, for one exp and one sqrt at the end.
  double density_on_side(const Vec2& a, const Vec2& b, std::size_t i, std::size_t j) const {
    const std::size_t first = next_begins_ - i, last = next_begins_ + j;
    const double to_a = a.dot(between_[first]), to_b = b.dot(between_[last]);
    if (!(to_a > 0 && to_b > 0)) return 0.0;
    const Vec2 p = between_[first] / to_a;
    const Vec2 side = between_[last] / to_b - p;
    const double from_p = cross(p, side);
    const double per_beam = 1.0 / static_cast<double>(last - first);
    const double h = (1.0 / to_b - 1.0 / to_a) * per_beam;
    double squares = 0.0, growth = 1.0, uniform = 1.0;
    for (std::size_t k = first; k < last; ++k) {
      const Member& m = members_[k];
      const double t = (static_cast<double>(k - first) + 0.5) * per_beam;
      const double q = ((1 - t) * (1 - t) + t * t) * h * h / 12.0 * m.inverse_variance;
      const double c = cross(readings_[k].direction, side);
      const double error = readings_[k].range_m * c - from_p;  // times c
      const double squared = error * error * m.inverse_variance / (c * c * (1.0 + q));
      if (is_on_side(squared, q, m.nats_of_uniform)) {
        squares += squared;
        growth *= 1.0 + q;
      } else {
        uniform *= m.uniform;
      }
    }
    return uniform * std::exp(-0.5 * squares) / std::sqrt(growth);
  }

 private:
  struct Member {
    double inverse_variance = 0.0;
    double uniform = 0.0;          // density of a uniform reading, divided by that of a normal error of 0
    double nats_of_uniform = 0.0;  // -2 log(uniform)
  };

  // squared + log(1 + q) < nats; 0 <= log(1 + q) <= q decides most.
  static bool is_on_side(double squared, double q, double nats) {
    if (squared + q < nats) return true;
    return squared < nats && squared + std::log1p(q) < nats;
  }

  void add(const BeamReading& reading, const ReadingNoise& noise) {
    const double variance = noise.variance(reading.range_m, 0.0);
    const double uniform = std::sqrt(variance * kTwoPi) / reading.range_m;
    members_[size_] = {1.0 / variance, uniform, -2.0 * std::log(uniform)};
    readings_[size_++] = reading;
  }

  static constexpr std::size_t kMost = 2 * kLongestTail + 2;
  std::array<BeamReading, kMost> readings_;
  std::array<Member, kMost> members_;
  std::array<Vec2, kMost> between_;  // directions between a reading and the one before
  std::size_t size_ = 0;
  std::size_t next_begins_ = 0;
};

using ShortenedByNumber = std::array<Shortened, kLongestTail + 1>;

ShortenedByNumber shortened_lines(const BeamLine& fit, const UncertainEnd& end) {
  ShortenedByNumber lines;
  for (std::size_t i = 0; i <= as_index(end.longest); ++i) lines[i] = without_tail(fit, end.tails[i]);
  return lines;
}

double likelihood_ratio(double gain) {
  return std::exp(std::min(gain, kLargestEndGain));
}

UncertainEnd possible_tails(const FittedReadings& line, const ReadingNoise& noise, End end, int min_readings) {
  UncertainEnd open;
  open.longest = longest_tail(line.readings, min_readings);
  open.tails = tails_of(line.fit, line.readings, noise, end, open.longest);
  return open;
}

}  // namespace

UncertainEnd end_towards_range(const FittedReadings& line, const ReadingNoise& noise, End end, double range_m,
                               int min_readings) {
  UncertainEnd open = possible_tails(line, noise, end, min_readings);
  for (std::size_t j = 1; j <= as_index(open.longest); ++j) {
    const BeamReading& b = reading_from_end(line.readings, end, j - 1);
    const double r = line.fit.range(b.direction);
    const double s = reading_sigma(noise, r, r * r * cross(line.fit.theta, b.direction));
    open.without_side[j] = open.without_side[j - 1] * 0.5 * density_between(b.range_m, r, range_m, s);
  }
  return open;
}

// The density of a side between two cuts is computed once, for both lines. For each of them it is summed over the
// number of readings of the other one that are on the side as well.
std::array<UncertainEnd, 2> ends_at_junction(const FittedReadings& line, const FittedReadings& next,
                                             const ReadingNoise& noise, int min_readings) {
  std::array<UncertainEnd, 2> ends = {possible_tails(line, noise, End::last, min_readings),
                                      possible_tails(next, noise, End::first, min_readings)};
  const std::size_t of_line = as_index(ends[0].longest), of_next = as_index(ends[1].longest);
  const ShortenedByNumber lines = shortened_lines(line.fit, ends[0]), nexts = shortened_lines(next.fit, ends[1]);
  const Junction junction(line.readings, next.readings, ends[0].longest, ends[1].longest, noise);
  const auto cuts = static_cast<double>((of_line + 1) * (of_next + 1) - 1);
  std::array<double, kLongestTail + 1> ratio_of_next{};
  for (std::size_t j = 0; j <= of_next; ++j)
    if (nexts[j].valid) ratio_of_next[j] = likelihood_ratio(nexts[j].gain) / cuts;
  for (std::size_t i = 0; i <= of_line; ++i) {
    if (!lines[i].valid) continue;
    const double ratio_of_line = likelihood_ratio(lines[i].gain) / cuts;
    for (std::size_t j = 0; j <= of_next; ++j) {
      if (i + j == 0 || !nexts[j].valid) continue;
      const double density = junction.density_on_side(lines[i].theta, nexts[j].theta, i, j);
      ends[0].with_side[i] += ratio_of_next[j] * density;
      ends[1].with_side[j] += ratio_of_line * density;
    }
  }
  return ends;
}

UncertainEnds::UncertainEnds(const BeamLine& fit, const std::array<UncertainEnd, 2>& ends) : fit_(fit), open_(ends) {
  if (open_[0].longest + open_[1].longest == 0) return;
  for (std::size_t i = 0; i <= as_index(open_[0].longest); ++i)
    for (std::size_t j = 0; j <= as_index(open_[1].longest); ++j) {
      const Shortened line = without_tail(fit_, open_[0].tails[i] + open_[1].tails[j]);
      if (!line.valid) continue;
      const Vec2 step = line.theta - fit_.theta;
      hypotheses_[i][j] = {likelihood_ratio(line.gain), step, line.covariance + step * step.transpose()};
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
      const Hypothesis& h = hypotheses_[i][j];
      const double weight = h.weight * density(0, i) * density(1, j);
      total += weight;
      mean += weight * h.step;
      second += weight * h.second;
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
