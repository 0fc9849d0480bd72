// Draws a small line chart as inline SVG.
#include "harness/results/document/sparkline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/special_values.hpp"
#include "harness/results/document/plain_text.hpp"

namespace scanbench::results {
namespace {

constexpr double kSparkWidth = 120.0;
constexpr double kSparkHeight = 24.0;
constexpr double kSparkMargin = 3.0;

}  // namespace

std::string sparkline(std::span<const double> values, const std::string& label) {
  double low = kInf;
  double high = -kInf;
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  const auto x = [&](std::size_t i) {
    const double steps = static_cast<double>(std::max<std::size_t>(values.size(), 2) - 1);
    return kSparkMargin + (kSparkWidth - 2 * kSparkMargin) * static_cast<double>(i) / steps;
  };
  const auto y = [&](double v) {
    return high > low ? kSparkHeight - kSparkMargin - (kSparkHeight - 2 * kSparkMargin) * (v - low) / (high - low)
                      : 0.5 * kSparkHeight;
  };
  std::string path;
  std::string last;
  bool joined = false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) {
      joined = false;
      continue;
    }
    path += fmt::format("{}{:.1f} {:.1f}", joined ? "L" : "M", x(i), y(values[i]));
    last = fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="2.5" fill="currentColor"/>)", x(i), y(values[i]));
    joined = true;
  }
  return fmt::format(
      "<svg class=\"spark\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" role=\"img\" "
      "aria-label=\"{2}\"><path d=\"{3}\" fill=\"none\" stroke=\"currentColor\" stroke-width=\"1.5\"/>{4}</svg>",
      kSparkWidth, kSparkHeight, html_escaped(label), path, last);
}

}  // namespace scanbench::results
