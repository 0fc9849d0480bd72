#include "core/geometry.hpp"

#include <gtest/gtest.h>

#include "core/least_squares.hpp"
#include "core/modules.hpp"
#include "core/recording.hpp"
#include "core/registry.hpp"
#include "core/result.hpp"
#include "core/rng.hpp"

namespace scanbench {
namespace {

TEST(LineDifference, TreatsALineAndItsOppositeFormAsOne) {
  const auto d = line_difference({0.001, 0.3}, {0.001, wrap_angle(0.3 + kPi)});
  EXPECT_NEAR(d.rho, 0.002, 1e-15);
  EXPECT_NEAR(d.alpha, 0.0, 1e-15);
}

}  // namespace
}  // namespace scanbench
