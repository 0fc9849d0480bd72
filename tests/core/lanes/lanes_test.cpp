// Lanes against the same operations on single numbers.
#include "core/lanes/lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/rng.hpp"

namespace scanbench {
namespace {

using FourDoubles = Lanes<double, 4>;
using EightFloats = Lanes<float, 8>;

TEST(Lanes, AreLoadedFromAndStoredToAnyAddress) {
  std::vector<double> numbers{0, 1, 2, 3, 4, 5, 6};
  for (int at = 0; at < 3; ++at) {
    const auto v = load<FourDoubles>(numbers.data() + at);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(v[i], at + i);
  }
  store(numbers.data() + 1, all<FourDoubles>(9.0));
  EXPECT_EQ(numbers, (std::vector<double>{0, 9, 9, 9, 9, 5, 6}));
}

TEST(Lanes, AreSelectedByAMaskWithAllTheirBits) {
  const FourDoubles a{1, -0.0, 3, std::numeric_limits<double>::quiet_NaN()}, b{5, 6, 7, 8};
  const auto mask = FourDoubles{0, 1, 0, 1} > 0.5;
  const FourDoubles chosen = select(mask, a, b), kept = masked(mask, a);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(double{chosen[i]}),
              std::bit_cast<std::uint64_t>(double{mask[i] ? a[i] : b[i]}));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(double{kept[i]}),
              std::bit_cast<std::uint64_t>(double{mask[i] ? a[i] : 0.0}));
  }
}

TEST(Lanes, FirstLanesAreTrueUpToTheirCount) {
  for (int count = -1; count < 12; ++count) {
    const auto doubles = first_lanes<FourDoubles>(count);
    const auto floats = first_lanes<EightFloats>(count);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(doubles[i], i < count ? -1 : 0);
    for (int i = 0; i < 8; ++i) EXPECT_EQ(floats[i], i < count ? -1 : 0);
  }
}

TEST(Lanes, TotalsAreExactWhereSumsAre) {
  EXPECT_EQ(total(FourDoubles{1, 20, 300, 4000}), 4321.0);
  EXPECT_EQ(total(EightFloats{1, 2, 4, 8, 16, 32, 64, 128}), 255.0F);
}

TEST(Lanes, AbsoluteValuesClearTheSignAlone) {
  const FourDoubles v = abs(FourDoubles{-2.5, -0.0, 7, -std::numeric_limits<double>::infinity()});
  EXPECT_EQ(v[0], 2.5);
  EXPECT_FALSE(std::signbit(v[1]));
  EXPECT_EQ(v[2], 7.0);
  EXPECT_EQ(v[3], std::numeric_limits<double>::infinity());
  EXPECT_EQ(abs(EightFloats{-1.5F})[0], 1.5F);
}

TEST(Lanes, OfARegisterCompareAndTakeRootsLikeSingleNumbers) {
  CounterRng rng(3, RngStream::resampling);
  for (int round = 0; round < 1000; ++round) {
    const double x = rng.normal(), y = rng.normal();
    const Doubles a = all(x), b = all(y);
    EXPECT_EQ(max(a, b)[kLanes - 1], std::max(x, y));
    EXPECT_EQ(min(a, b)[kLanes - 1], std::min(x, y));
    EXPECT_EQ(sqrt(all(std::fabs(x)))[0], std::sqrt(std::fabs(x)));
    EXPECT_EQ(opposite(a, b)[0] != 0, std::signbit(x) != std::signbit(y));
    EXPECT_EQ(mask_bits(a < b), x < y ? (1 << kLanes) - 1 : 0);
  }
  EXPECT_EQ(multiply_low_halves(all<Words>(0xffffffff00000003ULL), all<Words>(0x1ffffffffULL))[0],
            3ULL * 0xffffffffULL);
  std::vector<int> whole(kLanes);
  store_whole(whole.data(), all(-7.0));
  EXPECT_EQ(whole, std::vector<int>(kLanes, -7));
}

}  // namespace
}  // namespace scanbench
