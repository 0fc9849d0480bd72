// Lines whose ends are uncertain: properties that follow from Bayes' rule if the readings are drawn from the model.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "algorithms/extract/optimal/line_ends.hpp"
#include "core/rng.hpp"

namespace scanbench::extract {
namespace {

constexpr double kEndSigma = 0.02;
constexpr int kEndReadings = 40;

// A wall x = 2 m whose last readings, j with probability proportional to 2^-j, lie anywhere between it and x = 2.15 m.
std::vector<BeamReading> wall_with_a_tail(std::uint32_t seed, bool tail) {
  CounterRng rng(seed, RngStream::range);
  int foreign = 0;
  if (tail) {
    double u = rng.uniform() * (2.0 - std::pow(0.5, 6));
    for (double share = 1.0; u > share; share *= 0.5, ++foreign) u -= share;
  }
  std::vector<BeamReading> readings;
  for (int i = 0; i < kEndReadings; ++i) {
    const double phi = -0.3 + 0.02 * i;
    const double x = i >= kEndReadings - foreign ? 2.0 + 0.15 * rng.uniform() : 2.0;
    readings.push_back({{std::cos(phi), std::sin(phi)}, x / std::cos(phi) + kEndSigma * rng.normal()});
  }
  return readings;
}

SensorNoise end_noise() {
  SensorNoise n;
  n.sigma_m = kEndSigma;
  return n;
}

UncertainLine averaged_line(const BeamLine& line, const std::array<UncertainEnd, 2>& ends) {
  return UncertainEnds(line, ends).average(0.5);
}

// Readings whose last end is next to a reading of this range.
UncertainLine averaged_before_range(const BeamLine& line, std::span<const BeamReading> readings, double range_m,
                                    int min_readings = 3) {
  return averaged_line(line,
                       {{{}, end_towards_range({line, readings}, end_noise(), End::last, range_m, min_readings)}});
}

double squared_error(const BeamLine& line) {
  const Vec2 e = line.theta - Vec2(0.5, 0.0);
  return e.dot(line.information * e);
}

TEST(LineEnds, NothingAdjacentChangesNothing) {
  const auto readings = wall_with_a_tail(1, false);
  const auto line = fit_beam_line(readings, end_noise());
  ASSERT_TRUE(line);
  const UncertainLine same = averaged_line(*line, {});
  EXPECT_EQ(same.line.theta, line->theta);
  EXPECT_EQ(same.line.information, line->information);
  EXPECT_EQ(same.foreign, (std::array{0, 0}));
}

TEST(LineEnds, ErrorsAreAsLargeAsTheWholeCovarianceSays) {
  // E[e e' | readings] = C when the truth is drawn from what C is averaged over, so e' C^-1 e has the mean 2.
  const int trials = 4000;
  double averaged = 0.0, plain = 0.0;
  for (std::uint32_t seed = 0; seed < trials; ++seed) {
    const auto readings = wall_with_a_tail(seed, true);
    const auto line = fit_beam_line(readings, end_noise());
    ASSERT_TRUE(line);
    averaged += squared_error(averaged_before_range(*line, readings, 2.15 / std::cos(0.5)).line) / trials;
    plain += squared_error(*line) / trials;
  }
  EXPECT_NEAR(averaged, 2.0, 4 * 2.0 / std::sqrt(trials));
  EXPECT_GT(plain, 2.5);  // the same readings assigned to the wall
}

// Two walls, x = 2 m and x = 2.15 m, with a straight side between them in every other scan. The cut between the lines
// is fixed: the side takes i readings before it and j after it, all pairs from 0 to 6 but (0, 0) being equally
// probable. It begins and ends anywhere between two beams.
struct Step {
  std::vector<BeamReading> first, second;
  std::array<int, 2> foreign{};
  bool side = false;
};

Step step_with_a_side(std::uint32_t seed, double side_probability) {
  CounterRng rng(seed, RngStream::range);
  const double step = 0.02;
  Step out;
  out.side = rng.uniform() < side_probability;
  if (out.side) {
    const int pair = 1 + static_cast<int>(48.0 * rng.uniform());
    out.foreign = {pair / 7, pair % 7};
  }
  const double begin = (-out.foreign[0] - 1 + rng.uniform()) * step;
  const double end = (out.foreign[1] - 1 + rng.uniform()) * step;
  const auto on = [](double x, double phi) { return Vec2(x, x * std::tan(phi)); };
  const Vec2 p = on(2.0, begin), q = on(2.15, end);
  for (int i = 0; i < 2 * kEndReadings; ++i) {
    const double phi = (i - kEndReadings) * step;
    const Vec2 d(std::cos(phi), std::sin(phi));
    double r = (i < kEndReadings ? 2.0 : 2.15) / d.x();
    if (i >= kEndReadings - out.foreign[0] && i < kEndReadings + out.foreign[1]) r = cross(p, q - p) / cross(d, q - p);
    (i < kEndReadings ? out.first : out.second).push_back({d, r + kEndSigma * rng.normal()});
  }
  return out;
}

TEST(LineEnds, SideBetweenTwoLinesIsDistinguishedFromThem) {
  const int trials = 3000;
  double averaged = 0.0, plain = 0.0, sides = 0.0, true_sides = 0.0;
  for (std::uint32_t seed = 0; seed < trials; ++seed) {
    const Step step = step_with_a_side(seed, 0.5);
    const auto line = fit_beam_line(step.first, end_noise()), next = fit_beam_line(step.second, end_noise());
    ASSERT_TRUE(line && next);
    const auto ends = ends_at_junction({*line, step.first}, {*next, step.second}, end_noise(), 3);
    const UncertainLine found = averaged_line(*line, {{{}, ends[0]}});
    averaged += squared_error(found.line) / trials;
    plain += squared_error(*line) / trials;
    sides += found.side[1] / trials;
    true_sides += step.side ? 1.0 / trials : 0.0;
  }
  // The variance of a place between two beams replaces its distribution, and the next line's parameters are those of
  // greatest likelihood, so 2 is not exact.
  EXPECT_NEAR(averaged, 2.0, 0.15);
  EXPECT_GT(plain, 4.0);
  // A prior probability of 1/2 gives the same posterior probability on average; the sd of a mean of 3000 is below 0.01.
  EXPECT_NEAR(sides, true_sides, 0.03);
}

TEST(LineEnds, FirstEndIsTheMirrorImageOfTheLast) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const Step step = step_with_a_side(seed, 1.0);
    const auto mirrored = [](std::vector<BeamReading> readings) {
      std::ranges::reverse(readings);
      for (BeamReading& b : readings) b.direction.y() = -b.direction.y();
      return readings;
    };
    const auto first = mirrored(step.first), second = mirrored(step.second);
    const auto line = fit_beam_line(step.first, end_noise()), next = fit_beam_line(step.second, end_noise());
    const auto image = fit_beam_line(first, end_noise()), next_image = fit_beam_line(second, end_noise());
    ASSERT_TRUE(line && next && image && next_image);
    const auto ends = ends_at_junction({*line, step.first}, {*next, step.second}, end_noise(), 3);
    const auto image_ends = ends_at_junction({*next_image, second}, {*image, first}, end_noise(), 3);
    const UncertainLine a = averaged_line(*line, {{{}, ends[0]}});
    const UncertainLine b = averaged_line(*image, {{image_ends[1], {}}});
    EXPECT_EQ(a.foreign[1], b.foreign[0]);
    EXPECT_NEAR(a.side[1], b.side[0], 1e-9);
    EXPECT_NEAR((a.line.theta - Vec2(b.line.theta.x(), -b.line.theta.y())).norm(), 0.0, 1e-9);
  }
}

// The sum over j of the density of i and j readings on the side, times the ratio of likelihoods of the next line
// without its j readings, reading by reading as section 5 of docs/algorithms/optimal.md states it.
double density_with_side(const Step& step, const BeamLine& line, const BeamLine& next, std::size_t i) {
  const auto all = [&](std::size_t k) { return k < kEndReadings ? step.first[k] : step.second[k - kEndReadings]; };
  const auto between = [&](std::size_t k) { return Vec2((all(k - 1).direction + all(k).direction).normalized()); };
  const Tails before = tails_of(line, step.first, end_noise(), End::last, kLongestTail);
  const Tails behind = tails_of(next, step.second, end_noise(), End::first, kLongestTail);
  double sum = 0.0;
  for (std::size_t j = i == 0 ? 1 : 0; j <= kLongestTail; ++j) {
    const Shortened a = without_tail(line, before[i]), b = without_tail(next, behind[j]);
    const std::size_t first = kEndReadings - i, last = kEndReadings + j;
    const Vec2 p = between(first) / a.theta.dot(between(first)), q = between(last) / b.theta.dot(between(last));
    const double h = (q.norm() - p.norm()) / static_cast<double>(last - first);
    double density = 1.0;
    for (std::size_t k = first; k < last; ++k) {
      const double t = (static_cast<double>(k - first) + 0.5) / static_cast<double>(last - first);
      const double sigma = std::sqrt(kEndSigma * kEndSigma + ((1 - t) * (1 - t) + t * t) * h * h / 12.0);
      const double error = all(k).range_m - cross(p, q - p) / cross(all(k).direction, q - p);
      density *= std::max(kEndSigma / sigma * std::exp(-0.5 * std::pow(error / sigma, 2)),
                          kEndSigma * std::sqrt(kTwoPi) / all(k).range_m);
    }
    sum += std::exp(b.gain) * density / 48.0;
  }
  return sum;
}

TEST(LineEnds, DensityWithASideIsTheProductOverItsReadings) {
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    const Step step = step_with_a_side(seed, 0.7);
    const auto line = fit_beam_line(step.first, end_noise()), next = fit_beam_line(step.second, end_noise());
    ASSERT_TRUE(line && next);
    const auto ends = ends_at_junction({*line, step.first}, {*next, step.second}, end_noise(), 3);
    for (std::size_t i = 0; i <= kLongestTail; ++i) {
      const double expected = density_with_side(step, *line, *next, i);
      EXPECT_NEAR(ends[0].with_side[i], expected, 1e-9 * expected) << "seed " << seed << ", " << i << " readings";
    }
  }
}

TEST(LineEnds, FarReadingsAreForeignAndFewRemain) {
  auto readings = wall_with_a_tail(3, false);
  for (std::size_t i = kEndReadings - 3; i < kEndReadings; ++i) readings[i].range_m += 0.12;
  const auto line = fit_beam_line(readings, end_noise());
  ASSERT_TRUE(line);
  const double range_m = 2.3 / std::cos(0.5);
  EXPECT_EQ(averaged_before_range(*line, readings, range_m).foreign[1], 3);
  EXPECT_EQ(averaged_before_range(*line, readings, range_m, kEndReadings).foreign[1], 0);
}

}  // namespace
}  // namespace scanbench::extract
