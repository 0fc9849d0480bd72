// The density of a pose by the guess, and the poses that the guess excludes.
#include <cmath>

#include <gtest/gtest.h>

#include "algorithms/match/parts/guess.hpp"
#include "core/rng.hpp"

namespace scanbench::matching {
namespace {

constexpr double kSigmaM = 0.1, kSigmaRad = 0.05;
const Guess kGuess(Pose2(1.0, 2.0, 3.0), kSigmaM, kSigmaRad);

TEST(Guess, DensityOfHeadingsHasTheSumOne) {
  const int steps = 200000;
  double sum = 0.0;
  for (int k = 0; k < steps; ++k) {
    const double off = kTwoPi * ((k + 0.5) / steps - 0.5);
    sum += std::exp(kGuess.log_density(moved(kGuess.pose(), {0, 0, off})));
  }
  EXPECT_NEAR(sum * kTwoPi / steps / (std::sqrt(kTwoPi) * kSigmaRad), 1.0, 1e-6);
}

TEST(Guess, AHeadingMayBeAnyButAPositionMayNot) {
  const double turned = kGuess.log_density(moved(kGuess.pose(), {0, 0, 3.0}));
  EXPECT_NEAR(turned, std::log(0.01 * kSigmaRad / std::sqrt(kTwoPi)), 1e-9);
  const double shifted = kGuess.log_density(moved(kGuess.pose(), {6 * kSigmaM, 0, 0}));
  EXPECT_NEAR(shifted - kGuess.log_density(kGuess.pose()), -18.0, 1e-9);
}

TEST(Guess, ExcludesOneInAThousandOfItsOwnErrors) {
  CounterRng rng(5, RngStream::pose);
  const int draws = 200000;
  int poses = 0, positions = 0;
  for (int k = 0; k < draws; ++k) {
    const double x = kSigmaM * rng.normal(), y = kSigmaM * rng.normal(), yaw = kSigmaRad * rng.normal();
    const Pose2 pose = moved(kGuess.pose(), {x, y, yaw});
    poses += kGuess.excludes(pose) ? 1 : 0;
    positions += kGuess.excludes_position(pose) ? 1 : 0;
  }
  const double five_sigma = 5.0 * std::sqrt(1e-3 / draws);
  EXPECT_NEAR(1.0 * poses / draws, 1e-3, five_sigma);
  EXPECT_NEAR(1.0 * positions / draws, 1e-3, five_sigma);
}

}  // namespace
}  // namespace scanbench::matching
