// The Pareto front, against its definition.
#include "core/pareto.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/rng.hpp"
#include "core/special_values.hpp"

namespace scanbench {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

using Costs = std::vector<std::pair<double, double>>;

TEST(ParetoFront, HasThePairsThatNoOtherBeats) {
  for (std::uint32_t round = 0; round < 100; ++round) {
    CounterRng rng(1, RngStream::pose, round);
    Costs costs;  // of few different values, so that many are equal
    for (int k = 0; k < 12; ++k) costs.emplace_back(std::floor(6 * rng.uniform()), std::floor(6 * rng.uniform()));
    const std::vector<std::size_t> front = pareto_front(costs);
    for (std::size_t i = 0; i < costs.size(); ++i) {
      const bool beaten = std::ranges::any_of(costs, [&](const auto& other) {
        return other.first <= costs[i].first && other.second <= costs[i].second && other != costs[i];
      });
      EXPECT_EQ(std::ranges::count(front, i), beaten ? 0 : 1) << round << ", " << i;
    }
    EXPECT_TRUE(std::ranges::is_sorted(front, {}, [&](std::size_t i) { return costs[i].first; }));
  }
}

TEST(ParetoFront, LeavesOutWhatHasNoCost) {
  EXPECT_THAT(pareto_front(Costs{{kNaN, 0.0}, {2.0, 1.0}, {1.0, kNaN}, {1.0, 3.0}}), ElementsAre(3U, 1U));
  EXPECT_THAT(pareto_front(Costs{}), IsEmpty());
}

}  // namespace
}  // namespace scanbench
