// Disjoint sets against a brute-force closure of the same pairs.
#include "core/disjoint_sets.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/rng.hpp"

namespace scanbench {
namespace {

using ::testing::ElementsAre;

TEST(DisjointSets, AreSingleNumbersAtFirst) {
  DisjointSets sets(3);
  EXPECT_THAT(sets.labels(), ElementsAre(0, 1, 2));
  EXPECT_TRUE(DisjointSets(0).labels().empty());
}

TEST(DisjointSets, AreRepresentedByTheirSmallestMemberInAnyOrderOfPairs) {
  DisjointSets sets(5);
  sets.unite(4, 3);
  sets.unite(3, 1);
  sets.unite(1, 4);
  EXPECT_EQ(sets.find(4), 1u);
  EXPECT_EQ(sets.find(3), 1u);
  EXPECT_THAT(sets.labels(), ElementsAre(0, 1, 2, 1, 1));
}

TEST(DisjointSets, AreTheConnectedComponentsOfTheirPairs) {
  constexpr std::size_t kNumbers = 30;
  CounterRng rng(7, RngStream::range);
  for (int round = 0; round < 50; ++round) {
    DisjointSets sets(kNumbers);
    bool linked[kNumbers][kNumbers] = {};
    for (std::size_t i = 0; i < kNumbers; ++i) linked[i][i] = true;
    for (int pair = 0; pair < round; ++pair) {
      const auto a = static_cast<std::size_t>(rng.uniform() * kNumbers);
      const auto b = static_cast<std::size_t>(rng.uniform() * kNumbers);
      sets.unite(a, b);
      linked[a][b] = linked[b][a] = true;
    }
    for (std::size_t k = 0; k < kNumbers; ++k)  // Warshall: all connections by way of k
      for (std::size_t i = 0; i < kNumbers; ++i)
        for (std::size_t j = 0; j < kNumbers; ++j) linked[i][j] = linked[i][j] || (linked[i][k] && linked[k][j]);
    const std::vector<int> labels = sets.labels();
    for (std::size_t i = 0; i < kNumbers; ++i)
      for (std::size_t j = 0; j < kNumbers; ++j) {
        EXPECT_EQ(labels[i] == labels[j], linked[i][j]) << i << " " << j;
        EXPECT_EQ(sets.find(i) == sets.find(j), linked[i][j]) << i << " " << j;
      }
  }
}

}  // namespace
}  // namespace scanbench
