// The order of scans from worst to best.
#include "harness/results/figures/scan_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace scanbench::results {
namespace {

TEST(ScanError, OrdersByF1AndThenByFaults) {
  // Neighbouring values of F1 for scans of 150 lines and 150 walls: 2 t / 300.
  EXPECT_GT(scan_error(198.0 / 300.0, 0), scan_error(200.0 / 300.0, 999));
  EXPECT_GT(scan_error(0.5, 4), scan_error(0.5, 3));
  EXPECT_EQ(scan_error(0.5, 3), scan_error(0.5, 3));
  EXPECT_GT(scan_error(0.0, 1), scan_error(0.1, 1));
  EXPECT_TRUE(std::isnan(scan_error(std::numeric_limits<double>::quiet_NaN(), 2)));
}

}  // namespace
}  // namespace scanbench::results
