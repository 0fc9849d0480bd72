// Disjoint sets of numbers: which of them are connected by pairs.
#pragma once

#include <cstddef>
#include <vector>

namespace scanbench {

/// Disjoint sets of 0 .. n-1, each number by itself at first. The representative of a set is its smallest member, so
/// that answers do not depend on the order in which pairs are united.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n);
  /// The representative of the set that contains i.
  std::size_t find(std::size_t i);
  void unite(std::size_t a, std::size_t b);
  /// For each number the index of its set; sets are numbered from 0 in the order of their smallest members.
  std::vector<int> labels();

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace scanbench
