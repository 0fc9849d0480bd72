// Ticks of linear and logarithmic axes.
#include "core/ticks.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.hpp"

namespace scanbench {
namespace {

TEST(Ticks, LieInsideTheRangeAtMultiplesOfARoundStep) {
  for (std::uint32_t i = 0; i < 500; ++i) {
    CounterRng rng(1, RngStream::pose, i);
    const double low = (rng.uniform() - 0.5) * 100, span = std::pow(10.0, 8 * rng.uniform() - 4);
    const std::vector<Tick> ticks = linear_ticks(low, low + span, 6);
    ASSERT_GE(ticks.size(), 2u) << low << " + " << span;
    ASSERT_LE(ticks.size(), 7u);
    const double apart = ticks[1].value - ticks[0].value;
    const double step = round_below(apart * (1 + 1e-6));  // 1, 2 or 5 x 10^k
    EXPECT_NEAR(apart, step, 1e-6 * step + 1e-13);
    for (std::size_t k = 0; k < ticks.size(); ++k) {
      EXPECT_GE(ticks[k].value, low);
      EXPECT_LE(ticks[k].value, low + span);
      EXPECT_NEAR(std::remainder(ticks[k].value, step), 0.0, 1e-6 * step + 1e-12);
      if (k > 0) {
        EXPECT_NEAR(ticks[k].value - ticks[k - 1].value, step, 1e-6 * step + 1e-12);
      }
    }
  }
}

TEST(Ticks, HaveAsManyDecimalsAsTheStepAndATrueMinusSign) {
  const std::vector<Tick> ticks = linear_ticks(-0.2, 0.2, 4);
  ASSERT_EQ(ticks.size(), 5u);
  EXPECT_EQ(ticks[0], (Tick{-0.2, "\u22120.2"}));
  EXPECT_EQ(ticks[2], (Tick{0.0, "0.0"}));
  EXPECT_EQ(ticks[3], (Tick{0.1, "0.1"}));
  EXPECT_EQ(linear_ticks(0, 40, 4)[1], (Tick{10, "10"}));
}

TEST(Ticks, OfARangeWithoutWidthOrNotFiniteAreNone) {
  EXPECT_TRUE(linear_ticks(1, 1, 5).empty());
  EXPECT_TRUE(linear_ticks(2, 1, 5).empty());
  EXPECT_TRUE(linear_ticks(0, INFINITY, 5).empty());
  EXPECT_TRUE(linear_ticks(NAN, 1, 5).empty());
  EXPECT_TRUE(log_ticks(0, 10, 5).empty());
  EXPECT_TRUE(log_ticks(-1, 10, 5).empty());
  EXPECT_TRUE(linear_ticks(1e15, 1e15 + 0.25, 5).empty()) << "no two of them would be different numbers";
}

TEST(LogTicks, ArePowersOfTenOverManyDecades) {
  const std::vector<Tick> ticks = log_ticks(0.005, 2000, 8);
  const std::vector<Tick> expected{{0.01, "0.01"}, {0.1, "0.1"}, {1, "1"}, {10, "10"}, {100, "100"}, {1000, "1000"}};
  ASSERT_EQ(ticks.size(), expected.size());
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    EXPECT_DOUBLE_EQ(ticks[i].value, expected[i].value);
    EXPECT_EQ(ticks[i].label, expected[i].label);
  }
}

TEST(LogTicks, AreOneTwoFiveWithinADecade) {
  const std::vector<Tick> ticks = log_ticks(1.5, 9, 8);
  ASSERT_EQ(ticks.size(), 2u);
  EXPECT_EQ(ticks[0], (Tick{2, "2"}));
  EXPECT_EQ(ticks[1], (Tick{5, "5"}));
}

TEST(DecadeTicks, AreOneTwoFiveOfEveryDecade) {
  const std::vector<Tick> ticks = decade_ticks(0.5, 100);
  const std::vector<Tick> expected{{0.5, "0.5"}, {1, "1"},   {2, "2"},   {5, "5"},
                                   {10, "10"},   {20, "20"}, {50, "50"}, {100, "100"}};
  EXPECT_EQ(ticks, expected);
  EXPECT_EQ(decade_ticks(1e6, 2e6).back().label, "2e+06");
  EXPECT_TRUE(decade_ticks(0, 10).empty());
  EXPECT_TRUE(decade_ticks(2, 1).empty());
}

TEST(RoundBelow, IsTheLargestOneTwoFiveNotAbove) {
  EXPECT_DOUBLE_EQ(round_below(1.99), 1);
  EXPECT_DOUBLE_EQ(round_below(2), 2);
  EXPECT_DOUBLE_EQ(round_below(4.9), 2);
  EXPECT_DOUBLE_EQ(round_below(99), 50);
  EXPECT_DOUBLE_EQ(round_below(1000), 1000);
  EXPECT_DOUBLE_EQ(round_below(0.07), 0.05);
}

}  // namespace
}  // namespace scanbench
