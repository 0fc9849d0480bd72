// Chooses the worst scans first, because readers look for them.
#include "harness/results/player/scan_choice.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace scanbench::results {

std::vector<std::size_t> choose_scans(std::span<const double> errors, std::size_t most) {
  std::vector<std::size_t> order(errors.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (errors.size() <= most) return order;
  std::ranges::stable_sort(order, std::ranges::greater{},
                           [&](std::size_t i) { return std::isnan(errors[i]) ? -INFINITY : errors[i]; });
  const auto worst = static_cast<std::ptrdiff_t>(most / 2);
  std::vector<std::size_t> chosen(order.begin(), order.begin() + worst);
  std::vector<std::size_t> others(order.begin() + worst, order.end());
  std::ranges::sort(others);
  const std::size_t places = most - chosen.size();
  for (std::size_t k = 0; k < places; ++k) chosen.push_back(others[k * others.size() / places]);
  std::ranges::sort(chosen);
  return chosen;
}

}  // namespace scanbench::results
