// Medians by hand.
#include "core/median.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace scanbench {
namespace {

TEST(Median, IsTheMiddleValueOrTheMeanOfTheTwoMiddleOnes) {
  EXPECT_EQ(median({5.0}), 5.0);
  EXPECT_EQ(median({9.0, -1.0, 2.0}), 2.0);
  EXPECT_EQ(median({4.0, 1.0, 2.0, 100.0}), 3.0);
  EXPECT_EQ(median({INFINITY, 1.0, 2.0}), 2.0);
  EXPECT_TRUE(std::isnan(median({})));
}

TEST(Median, TheUpperOneIsAlwaysOneOfTheValues) {
  EXPECT_EQ(upper_median({5.0}), 5.0);
  EXPECT_EQ(upper_median({9.0, -1.0, 2.0}), 2.0);
  EXPECT_EQ(upper_median({4.0, 1.0, 2.0, 100.0}), 4.0);
  EXPECT_TRUE(std::isnan(upper_median({})));
}

}  // namespace
}  // namespace scanbench
