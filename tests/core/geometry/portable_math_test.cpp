// The portable functions compared with long double, and their special values.
#include "core/geometry/portable_math.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/angles.hpp"
#include "core/rng.hpp"
#include "core/special_values.hpp"

namespace scanbench {
namespace {

// Distance in units in the last place of the exact value.
double ulps(double value, long double exact) {
  const auto rounded = static_cast<double>(exact);
  const double ulp = std::nextafter(std::fabs(rounded), kInf) - std::fabs(rounded);
  return static_cast<double>(std::fabs(static_cast<long double>(value) - exact) / static_cast<long double>(ulp));
}

template <class Function>
void for_many(double low, double high, const Function& function) {
  CounterRng rng(7, RngStream::pose);
  for (int i = 0; i < 200000; ++i) function(low + (high - low) * rng.uniform());
}

TEST(PortableMath, SineAndCosineStayWithinTwoUlpOverTenTurns) {
  double worst = 0.0;
  for_many(-63.0, 63.0, [&](double x) {
    const auto [s, c] = portable::sincos(x);
    worst = std::max(
        {worst, ulps(s, std::sin(static_cast<long double>(x))), ulps(c, std::cos(static_cast<long double>(x)))});
  });
  EXPECT_LT(worst, 2.0);
}

TEST(PortableMath, SineAndCosineOfLargeAnglesKeepAbsoluteAccuracy) {
  double worst = 0.0;
  for_many(-1e5, 1e5, [&](double x) {
    const auto [s, c] = portable::sincos(x);
    worst = std::max({worst, std::fabs(s - static_cast<double>(std::sin(static_cast<long double>(x)))),
                      std::fabs(c - static_cast<double>(std::cos(static_cast<long double>(x))))});
  });
  EXPECT_LT(worst, 4e-16);
}

TEST(PortableMath, SincosOfMultiplesOfARightAngleIsAsExactAsTheAngle) {
  EXPECT_EQ(portable::sincos(0.0).sin, 0.0);
  EXPECT_EQ(portable::sincos(0.0).cos, 1.0);
  EXPECT_EQ(portable::sincos(kPi / 2).sin, 1.0);
  EXPECT_NEAR(portable::sincos(kPi).sin, 1.2246467991473532e-16, 1e-30);
}

TEST(PortableMath, ArcTangentStaysWithinTwoUlpInAllQuadrants) {
  double worst = 0.0;
  CounterRng rng(8, RngStream::pose);
  for (int i = 0; i < 200000; ++i) {
    const double x = rng.normal();
    const double y = rng.normal() * portable::exp(10 * rng.normal());
    worst = std::max(worst,
                     ulps(portable::atan2(y, x), std::atan2(static_cast<long double>(y), static_cast<long double>(x))));
  }
  EXPECT_LT(worst, 2.0);
}

TEST(PortableMath, ArcTangentOnTheAxes) {
  EXPECT_EQ(portable::atan2(0.0, 1.0), 0.0);
  EXPECT_EQ(portable::atan2(0.0, -1.0), kPi);
  EXPECT_EQ(portable::atan2(1.0, 0.0), kPi / 2);
  EXPECT_EQ(portable::atan2(-1.0, 0.0), -kPi / 2);
  EXPECT_EQ(portable::atan2(0.0, 0.0), 0.0);
  EXPECT_TRUE(std::isnan(portable::atan2(kNaN, 1.0)));
}

TEST(PortableMath, LogarithmStaysWithinTwoUlp) {
  double worst = 0.0;
  for_many(-700.0, 700.0, [&](double e) {
    const double x = static_cast<double>(std::exp(static_cast<long double>(e)));
    worst = std::max(worst, ulps(portable::log(x), std::log(static_cast<long double>(x))));
  });
  for_many(0.5, 2.0,
           [&](double x) { worst = std::max(worst, ulps(portable::log(x), std::log(static_cast<long double>(x)))); });
  EXPECT_LT(worst, 2.0);
  EXPECT_EQ(portable::log(1.0), 0.0);
  EXPECT_EQ(portable::log(0.0), -kInf);
  EXPECT_TRUE(std::isnan(portable::log(-1.0)));
}

TEST(PortableMath, ExponentialStaysWithinTwoUlp) {
  double worst = 0.0;
  for_many(-700.0, 709.0,
           [&](double x) { worst = std::max(worst, ulps(portable::exp(x), std::exp(static_cast<long double>(x)))); });
  EXPECT_LT(worst, 2.0);
  EXPECT_EQ(portable::exp(0.0), 1.0);
  EXPECT_EQ(portable::exp(-1e9), 0.0);
  EXPECT_EQ(portable::exp(1e9), kInf);
}

}  // namespace
}  // namespace scanbench
