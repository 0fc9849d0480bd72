// The scans that a page holds when not all fit.
#include "harness/results/player/scan_choice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace scanbench::results {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;

TEST(ScanChoice, TakesAllThatFit) {
  const std::vector<double> errors{0.5, NAN, 0.1};
  EXPECT_THAT(choose_scans(errors, 3), ElementsAre(0U, 1U, 2U));
  EXPECT_THAT(choose_scans({}, 3), ElementsAre());
}

TEST(ScanChoice, KeepsTheWorstScansAndAnEvenSelectionOfTheOthersInOrder) {
  std::vector<double> errors(1000, 0.0);
  for (const std::size_t bad : {7U, 500U, 501U, 998U}) errors[bad] = 1.0 + static_cast<double>(bad);
  errors[3] = NAN;
  const auto chosen = choose_scans(errors, 100);
  ASSERT_EQ(chosen.size(), 100U);
  EXPECT_TRUE(std::ranges::is_sorted(chosen));
  EXPECT_EQ(std::ranges::adjacent_find(chosen), chosen.end());  // none twice
  for (const std::size_t bad : {7U, 500U, 501U, 998U}) EXPECT_THAT(chosen, Contains(bad));
  // Of the other half of the places every fifth of the recording has some.
  for (std::size_t part = 1; part < 5; ++part)
    EXPECT_GE(std::ranges::count_if(chosen, [&](std::size_t f) { return f / 200 == part; }), 8) << part;
}

TEST(ScanChoice, OfOnePlaceIsOneScan) {
  EXPECT_EQ(choose_scans(std::vector<double>{0.1, 0.9}, 1).size(), 1U);
}

}  // namespace
}  // namespace scanbench::results
