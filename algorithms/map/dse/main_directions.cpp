// Fills the histogram and takes its peaks by decreasing weight.
#include "algorithms/map/dse/main_directions.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/index.hpp"

namespace scanbench::mapping::dse {

std::array<Vec2, DirectionHistogram::kBins> DirectionHistogram::zeros() {
  std::array<Vec2, kBins> sums;
  sums.fill(Vec2::Zero());
  return sums;
}

void DirectionHistogram::add(const Segment& segment) {
  const double length = segment.length();
  if (!(length > 0)) return;
  const double angle = segment.direction_angle();
  const std::size_t bin = wrapped(static_cast<int>(std::lround(degrees(angle))));
  weight_m_[bin] += length;
  doubled_[bin] += length * Vec2(std::cos(2 * angle), std::sin(2 * angle));
  total_m_ += length;
}

double DirectionHistogram::window_m(int bin) const {
  double sum = 0.0;
  for (int b = bin - kHalfWindow; b <= bin + kHalfWindow; ++b) sum += weight_m(b);
  return sum;
}

double DirectionHistogram::mean_direction(int bin) const {
  Vec2 sum = Vec2::Zero();
  for (int b = bin - kHalfWindow; b <= bin + kHalfWindow; ++b) sum += doubled_[wrapped(b)];
  return direction_mod_pi(0.5 * std::atan2(sum.y(), sum.x()));
}

std::vector<MainDirection> main_directions(const DirectionHistogram& histogram, const PeakRule& rule) {
  constexpr int kBins = DirectionHistogram::kBins;
  std::array<double, as_index(kBins)> window{};
  for (int bin = 0; bin < kBins; ++bin) window[as_index(bin)] = histogram.window_m(bin);
  std::array<int, as_index(kBins)> order{};
  std::iota(order.begin(), order.end(), 0);
  // A group of directions in one bin fills five windows equally: the one with most weight in its middle comes first.
  std::ranges::stable_sort(order, [&](int a, int b) {
    const double wa = window[as_index(a)], wb = window[as_index(b)];
    return wa != wb ? wa > wb : histogram.weight_m(a) > histogram.weight_m(b);
  });
  std::vector<MainDirection> found;
  for (const int bin : order) {
    const double weight = window[as_index(bin)];
    if (!(weight > 0) || weight < rule.least_share * histogram.total_m()) break;
    const double angle = histogram.mean_direction(bin);
    const bool apart = std::ranges::all_of(found, [&](const MainDirection& other) {
      return std::abs(wrap_direction(angle - other.angle_rad)) >= rule.apart_rad;
    });
    if (apart) found.push_back({angle, weight});
  }
  return found;
}

}  // namespace scanbench::mapping::dse
