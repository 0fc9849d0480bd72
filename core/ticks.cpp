// Computes ticks at 1, 2, 5 x 10^k: Heckbert, "Nice numbers for graph labels", Graphics Gems, 1990.
#include "core/ticks.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "core/error.hpp"

namespace scanbench {
namespace {

/// With `digits` behind the point (fixed) or in all (general), as printf writes %f and %g.
std::string text_of(double value, std::chars_format format, int digits) {
  std::array<char, 400> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format, digits);
  return {buffer.data(), end};
}

std::string fixed_text(double value, int decimals) {
  return text_of(value, std::chars_format::fixed, decimals);
}

std::string power_label(int exponent) {
  if (exponent >= -3 && exponent <= 4) return fixed_text(std::pow(10.0, exponent), std::max(0, -exponent));
  return "1e" + std::to_string(exponent);
}

/// With a true minus sign, as wide as a plus.
std::string typographic(std::string number) {
  if (!number.empty() && number[0] == '-') number.replace(0, 1, "\u2212");
  return number;
}

std::string plain_label(double value, int exponent_of_step) {
  if (exponent_of_step >= -6 && std::abs(value) < 1e6)
    return typographic(fixed_text(value, std::max(0, -exponent_of_step)));
  return typographic(text_of(value, std::chars_format::general, 6));
}

}  // namespace

double round_below(double x) {
  SCANBENCH_ASSERT(x > 0 && std::isfinite(x));
  const double decade = std::pow(10.0, std::floor(std::log10(x)));
  double best = decade;
  for (const double m : {1.0, 2.0, 5.0, 10.0})  // 10: log10 of a power of ten may be slightly low
    if (m * decade <= x * (1 + 1e-12)) best = m * decade;
  return best;
}

std::vector<Tick> linear_ticks(double low, double high, int count) {
  return ticks_apart(low, high, (high - low) / std::max(1, count));
}

std::vector<Tick> ticks_apart(double low, double high, double least_step) {
  if (!(low < high) || !std::isfinite(high - low) || !(least_step > 0)) return {};
  int exponent = static_cast<int>(std::floor(std::log10(least_step)));
  int multiple = 1;
  for (;; ++exponent) {
    const double decade = std::pow(10.0, exponent) * (1 + 1e-9);
    if (multiple = 1; least_step <= decade) break;
    if (multiple = 2; least_step <= 2 * decade) break;
    if (multiple = 5; least_step <= 5 * decade) break;
  }
  // For k < 0 the step is a quotient by 10^-k: 3 / 10 is the double nearest to 0.3, 3 * 0.1 is not.
  const double up = exponent > 0 ? std::pow(10.0, exponent) : 1.0;
  const double down = exponent < 0 ? std::pow(10.0, -exponent) : 1.0;
  const double step = multiple * up / down;
  const double first = std::ceil(low / step - 1e-9);
  const double last = std::floor(high / step + 1e-9);
  std::vector<Tick> ticks;
  // No ticks if they are so far from zero that neighbouring multiples may be equal, or if there are too many.
  if (std::max(std::abs(first), std::abs(last)) > 1e12 || last - first > 1000) return ticks;
  for (double k = first; k <= last; k += 1.0) {
    const double value = k == 0 ? 0.0 : k * multiple * up / down;
    if (value >= low && value <= high) ticks.push_back({value, plain_label(value, exponent)});
  }
  return ticks;
}

std::vector<Tick> decade_ticks(double low, double high) {
  if (!(low > 0) || !(low < high) || !std::isfinite(high)) return {};
  std::vector<Tick> ticks;
  const int first = static_cast<int>(std::floor(std::log10(low))) - 1;
  const int last = static_cast<int>(std::ceil(std::log10(high))) + 1;
  for (int e = first; e <= last; ++e)
    for (const int m : {1, 2, 5}) {
      const double value = e < 0 ? m / std::pow(10.0, -e) : m * std::pow(10.0, e);
      if (value >= low && value <= high) ticks.push_back({value, plain_label(value, e)});
    }
  return ticks;
}

std::vector<Tick> log_ticks(double low, double high, int count) {
  if (!(low > 0) || !(low < high) || !std::isfinite(high)) return {};
  const int first = static_cast<int>(std::ceil(std::log10(low) - 1e-9));
  const int last = static_cast<int>(std::floor(std::log10(high) + 1e-9));
  if (last - first >= 1) {
    std::vector<Tick> ticks;
    const int stride = std::max(1, (last - first + std::max(1, count)) / std::max(1, count));
    for (int e = first; e <= last; e += stride) ticks.push_back({std::pow(10.0, e), power_label(e)});
    return ticks;
  }
  std::vector<Tick> ticks = decade_ticks(low, high);
  if (ticks.size() < 2) return linear_ticks(low, high, count);  // less than half a decade
  return ticks;
}

}  // namespace scanbench
