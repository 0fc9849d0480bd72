// Finds the Pareto front by one pass over the pairs in increasing order.
#include "core/pareto.hpp"

#include <algorithm>
#include <cmath>

namespace scanbench {

std::vector<std::size_t> pareto_front(std::span<const std::pair<double, double>> costs) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < costs.size(); ++i)
    if (!std::isnan(costs[i].first) && !std::isnan(costs[i].second)) order.push_back(i);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return costs[i]; });
  std::vector<std::size_t> front;  // the last has the lowest second cost so far
  for (const std::size_t i : order)
    if (front.empty() || costs[i].second < costs[front.back()].second || costs[i] == costs[front.back()])
      front.push_back(i);
  return front;
}

}  // namespace scanbench
