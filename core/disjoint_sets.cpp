// Union-find with path halving.
#include "core/disjoint_sets.hpp"

#include <algorithm>
#include <numeric>

namespace scanbench {

DisjointSets::DisjointSets(std::size_t n) : parent_(n) {
  std::iota(parent_.begin(), parent_.end(), std::size_t{0});
}

std::size_t DisjointSets::find(std::size_t i) {
  while (parent_[i] != i) {
    parent_[i] = parent_[parent_[i]];
    i = parent_[i];
  }
  return i;
}

void DisjointSets::unite(std::size_t a, std::size_t b) {
  a = find(a);
  b = find(b);
  parent_[std::max(a, b)] = std::min(a, b);
}

std::vector<int> DisjointSets::labels() {
  std::vector<int> result(parent_.size(), -1);
  int next = 0;
  for (std::size_t i = 0; i < parent_.size(); ++i) {
    const std::size_t root = find(i);  // root <= i, so it already has its label
    result[i] = root == i ? next++ : result[root];
  }
  return result;
}

}  // namespace scanbench
