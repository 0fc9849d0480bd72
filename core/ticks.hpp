// Round numbers for the axes of figures and of charts on pages, and for scale bars.
#pragma once

#include <string>
#include <vector>

namespace scanbench {

struct Tick {
  double value = 0.0;
  std::string label;
  bool operator==(const Tick&) const = default;
};

/// The largest of 1, 2, 5 x 10^k that is <= x. x must be positive and finite.
double round_below(double x);

/// Multiples of 1, 2 or 5 x 10^k inside [low, high], at most about `count` (>= 1), with as many decimals as the step
/// needs. Empty unless low < high, both finite.
std::vector<Tick> linear_ticks(double low, double high, int count);

/// The same with the smallest round step >= `least_step` > 0.
std::vector<Tick> ticks_apart(double low, double high, double least_step);

/// 1, 2, 5 x 10^k inside [low, high]. Empty unless 0 < low < high, both finite.
std::vector<Tick> decade_ticks(double low, double high);

/// Powers of ten inside [low, high], thinned to about `count`; 1, 2, 5 within the decades if there are fewer than two.
/// Empty unless 0 < low < high, both finite.
std::vector<Tick> log_ticks(double low, double high, int count);

}  // namespace scanbench
