// Elementary functions in lanes: bit for bit those of one number, or within the error that their comment states.
#include "core/lanes/elementary.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/portable_math.hpp"
#include "core/lanes/lanes.hpp"
#include "core/rng.hpp"

namespace scanbench {
namespace {

using FourFloats = Lanes<float, 4>;

TEST(ElementaryLanes, LogarithmsAreThePortableOnes) {
  CounterRng rng(1, RngStream::resampling);
  for (int round = 0; round < 100000; ++round) {
    const double x = rng.uniform() * portable::exp(20.0 * rng.normal());
    ASSERT_EQ(log(all(x))[0], portable::log(x)) << x;
  }
  for (const double x : {1.0, 0.70710678118654752440, 0x1p-1022, 0x1.fffffffffffffp1023})
    EXPECT_EQ(log(all(x))[0], portable::log(x)) << x;
}

TEST(ElementaryLanes, CosinesAreThePortableOnes) {
  CounterRng rng(2, RngStream::resampling);
  for (int round = 0; round < 100000; ++round) {
    const double x = (round % 2 == 0 ? 10.0 : 1e5) * rng.uniform();
    ASSERT_EQ(cos(all(x))[0], portable::sincos(x).cos) << x;
  }
  EXPECT_EQ(cos(all(0.0))[0], 1.0);
}

TEST(ElementaryLanes, PowersOfTwoAreWithinTheRemainderOfTheirSeries) {
  for (float y = -125.9F; y <= 0.0F; y += 0.0137F) {
    const double expected = std::exp2(static_cast<double>(y));
    EXPECT_NEAR(static_cast<double>(exp2(all<FourFloats>(y))[3]) / expected, 1.0, 4e-6) << y;
  }
  EXPECT_EQ(exp2(FourFloats{})[0], 1.0F);
}

TEST(ElementaryLanes, ReciprocalRootsAreWithinTheErrorOfTwoNewtonSteps) {
  for (float v = 1e-12F; v < 1e12F; v *= 1.0037F) {
    const double expected = 1.0 / std::sqrt(static_cast<double>(v));
    EXPECT_NEAR(static_cast<double>(reciprocal_root(all<FourFloats>(v))[1]) / expected, 1.0, 5e-6) << v;
  }
  EXPECT_TRUE(std::isfinite(reciprocal_root(FourFloats{})[0]));
}

}  // namespace
}  // namespace scanbench
