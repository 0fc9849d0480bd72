// Counter-based numbers: the published test vector, independence of order, moments.
#include "core/rng.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace scanbench {
namespace {

TEST(CounterRng, IsPhilox4x32WithTenRounds) {
  // Known answer of Random123's kat_vectors for a zero key and a zero counter. The stream is one word of the counter,
  // so the test needs a stream of number zero.
  CounterRng rng(0, static_cast<RngStream>(0), 0, 0);
  EXPECT_EQ(rng.bits(), 0x6627e8d5u);
  EXPECT_EQ(rng.bits(), 0xe169c58du);
  EXPECT_EQ(rng.bits(), 0xbc57ac4cu);
  EXPECT_EQ(rng.bits(), 0x9b00dbd8u);
}

TEST(CounterRng, GivesAnAddressTheSameNumbersInAnyOrder) {
  std::vector<double> forward;
  for (std::uint32_t beam = 0; beam < 50; ++beam) forward.push_back(CounterRng(3, RngStream::range, 7, beam).normal());
  for (std::uint32_t beam = 50; beam-- > 0;)
    EXPECT_EQ(CounterRng(3, RngStream::range, 7, beam).normal(), forward[beam]);
}

TEST(CounterRng, SeparatesSeedsStreamsFramesAndBeams) {
  const double base = CounterRng(3, RngStream::range, 7, 9).uniform();
  EXPECT_NE(base, CounterRng(4, RngStream::range, 7, 9).uniform());
  EXPECT_NE(base, CounterRng(3 + (1ull << 32), RngStream::range, 7, 9).uniform());
  EXPECT_NE(base, CounterRng(3, RngStream::dropout, 7, 9).uniform());
  EXPECT_NE(base, CounterRng(3, RngStream::range, 8, 9).uniform());
  EXPECT_NE(base, CounterRng(3, RngStream::range, 7, 10).uniform());
}

TEST(CounterRng, UniformAndNormalDrawsHaveTheMomentsOfTheirDistributions) {
  constexpr int kN = 1000000;
  CounterRng rng(11, RngStream::range);
  double u1 = 0, u2 = 0, n1 = 0, n2 = 0, n4 = 0;
  for (int i = 0; i < kN; ++i) {
    const double u = rng.uniform();
    ASSERT_GT(u, 0.0);
    ASSERT_LT(u, 1.0);
    const double n = rng.normal();
    u1 += u;
    u2 += u * u;
    n1 += n;
    n2 += n * n;
    n4 += n * n * n * n;
  }
  // Five standard errors of each mean: sd(u) = 0.289, sd(u^2) = 0.298, sd(n) = 1, sd(n^2) = sqrt 2, sd(n^4) = sqrt 96.
  const double se = 5.0 / std::sqrt(static_cast<double>(kN));
  EXPECT_NEAR(u1 / kN, 0.5, 0.289 * se);
  EXPECT_NEAR(u2 / kN, 1.0 / 3, 0.298 * se);
  EXPECT_NEAR(n1 / kN, 0.0, se);
  EXPECT_NEAR(n2 / kN, 1.0, 1.415 * se);
  EXPECT_NEAR(n4 / kN, 3.0, 9.8 * se);
}

}  // namespace
}  // namespace scanbench
