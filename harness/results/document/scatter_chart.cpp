// Draws points with names as inline SVG.
#include "harness/results/document/scatter_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "core/ticks.hpp"
#include "harness/results/document/plain_text.hpp"

namespace scanbench::results {
namespace {

// The frame, in pixels.
constexpr double kWidth = 480.0;
constexpr double kHeight = 300.0;
constexpr double kLeft = 62.0;
constexpr double kRight = 470.0;
constexpr double kTop = 12.0;
constexpr double kBottom = 252.0;
constexpr double kLetter = 7.2;  // width of a letter of the labels, in the widest of the page's fonts
constexpr double kLine = 13.0;   // height of their line
constexpr double kLongRange = 30.0;
constexpr double kShortestDecades = 0.3;  // a factor of two
constexpr double kShortestShare = 0.02;   // of the largest value

/// A scale from values to pixels.
struct Axis {
  double low, high;  // of the values, or of their logarithms
  double from, to;   // in pixels
  double operator()(double value) const { return from + (to - from) * (value - low) / (high - low); }
};

/// With a margin on both sides. An axis is at least `shortest` long, so that it does not magnify
/// differences that do not matter.
Axis axis_over(double low, double high, double shortest, double from, double to) {
  const double reach = std::max(0.08 * (high - low), 0.5 * (shortest - (high - low)));
  return {low - reach, high + reach, from, to};
}

constexpr int kTicks = 5;  // about as many on an axis of equal steps

/// Ticks of a logarithmic axis: powers of ten, 2 and 5 times these if the axis is short, and steps of equal size if it
/// spans no more than a factor of five.
std::vector<Tick> ticks_of_powers(const Axis& axis) {
  const double low = std::pow(10.0, axis.low), high = std::pow(10.0, axis.high), decades = axis.high - axis.low;
  if (decades < std::log10(5.0)) return linear_ticks(low, high, kTicks);
  return decades < 2.5 ? decade_ticks(low, high) : log_ticks(low, high, static_cast<int>(decades) + 1);
}

struct Box {
  double left, top, right, bottom;
  bool meets(const Box& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
};

class ScatterDrawing {
 public:
  explicit ScatterDrawing(const ScatterChart& chart) : chart_(chart) {
    for (const auto& point : chart.points)
      if (std::isfinite(point.x) && point.x > 0 && std::isfinite(point.y)) points_.push_back(point);
    // Names of the front are placed first; its points are joined from left to right.
    std::ranges::stable_sort(points_, {}, [](const ScatterPoint& p) { return std::pair(!p.on_front, p.x); });
  }

  std::string svg() {
    if (points_.empty()) return "";
    const auto [left, right] = std::ranges::minmax(points_, {}, &ScatterPoint::x);
    const auto [low, high] = std::ranges::minmax(points_, {}, &ScatterPoint::y);
    x_ = axis_over(std::log10(left.x), std::log10(right.x), kShortestDecades, kLeft, kRight);
    log_y_ = low.y > 0 && high.y > kLongRange * low.y;
    y_ = log_y_ ? axis_over(std::log10(low.y), std::log10(high.y), kShortestDecades, kBottom, kTop)
                : axis_over(low.y, high.y, kShortestShare * std::max(std::fabs(low.y), std::fabs(high.y)) + 1e-12,
                            kBottom, kTop);
    for (const auto& point : points_) taken_.push_back(around(point));
    const std::string points = dots();
    return fmt::format(
        "<svg class=\"chart\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">{}{}{}{}</svg>\n", kWidth,
        kHeight + (unnamed_ > 0 ? 14 : 0), html_escaped(plain_line(chart_.y_label + " against " + chart_.x_label)),
        axes(), front(), points, note());
  }

 private:
  double px(const ScatterPoint& point) const { return x_(std::log10(point.x)); }
  double py(const ScatterPoint& point) const { return at_y(point.y); }
  double at_y(double value) const { return y_(log_y_ ? std::log10(value) : value); }
  Box around(const ScatterPoint& point) const { return {px(point) - 5, py(point) - 5, px(point) + 5, py(point) + 5}; }

  std::string axes() const {
    std::string out = fmt::format(R"(<g class="axis"><path d="M{0} {1}V{2}H{3}"/>)", kLeft, kTop, kBottom, kRight);
    for (const Tick& tick : ticks_of_powers(x_)) {
      const double at = x_(std::log10(tick.value));
      out += fmt::format(R"(<path d="M{0:.1f} {1}v4"/><text x="{0:.1f}" y="{2}" text-anchor="middle">{3}</text>)", at,
                         kBottom, kBottom + 17, tick.label);
    }
    for (const Tick& tick : log_y_ ? ticks_of_powers(y_) : linear_ticks(y_.low, y_.high, kTicks)) {
      const double at = at_y(tick.value);
      out += fmt::format(R"(<path d="M{0} {1:.1f}h-4"/><text x="{2}" y="{3:.1f}" text-anchor="end">{4}</text>)", kLeft,
                         at, kLeft - 7, at + 4, tick.label);
    }
    out += fmt::format(R"(<text x="{:.1f}" y="{}" text-anchor="middle">{}</text>)", 0.5 * (kLeft + kRight), kHeight - 8,
                       html_escaped(plain_line(chart_.x_label)));
    return out +
           fmt::format("<text transform=\"translate(14 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text></g>",
                       0.5 * (kTop + kBottom), html_escaped(plain_line(chart_.y_label)));
  }

  std::string front() const {
    std::string path;
    for (const auto& point : points_) {
      if (!point.on_front) continue;
      path += path.empty() ? fmt::format("M{:.1f} {:.1f}", px(point), py(point))
                           : fmt::format("H{:.1f}V{:.1f}", px(point), py(point));
    }
    if (path.empty()) return "";
    return fmt::format(R"(<path class="front" d="{}H{:.0f}"/>)", path, kRight);
  }

  std::string dots() {
    std::string out;
    for (const auto& point : points_) {
      const std::string name = html_escaped(plain_line(point.name));
      out +=
          fmt::format(R"(<circle class="{}" cx="{:.1f}" cy="{:.1f}" r="4"><title>{}: {:.3g}, {:.3g}</title></circle>)",
                      point.on_front ? "on" : "off", px(point), py(point), name, point.x, point.y);
      out += label(point, name);
    }
    return out;
  }

  /// The name beside its point, at the first place that is free; empty if none is.
  std::string label(const ScatterPoint& point, const std::string& escaped) {
    const double width = kLetter * static_cast<double>(point.name.size());
    const double x = px(point);
    const double y = py(point);
    struct Place {
      double left, base;
    };
    // The steps of the front lead to the right of its points.
    const std::array<Place, 9> places{{{x + 6, y - 7},
                                       {x + 8, y + 4},
                                       {x - 8 - width, y + 4},
                                       {x - 0.5 * width, y - 9},
                                       {x - 0.5 * width, y + 17},
                                       {x + 4, y + 17},
                                       {x - 4 - width, y - 9},
                                       {x - 4 - width, y + 17},
                                       {x + 2, y - 20}}};  // one line higher
    for (const auto& place : std::span(places).subspan(point.on_front ? 0 : 1)) {
      const Box box{place.left, place.base - kLine + 3, place.left + width, place.base + 3};
      const bool inside = box.left >= kLeft + 2 && box.right <= kWidth && box.top >= 0 && box.bottom <= kBottom;
      if (!inside || std::ranges::any_of(taken_, [&](const Box& other) { return box.meets(other); })) continue;
      taken_.push_back(box);
      return fmt::format(R"(<text x="{:.1f}" y="{:.1f}">{}</text>)", place.left, place.base, escaped);
    }
    ++unnamed_;
    return "";
  }

  /// Tells the reader of a crowded chart where the other names are.
  std::string note() const {
    if (unnamed_ == 0) return "";
    return fmt::format(
        "<g class=\"axis\"><text x=\"{:.1f}\" y=\"{:.0f}\" text-anchor=\"middle\">{} name{} no room: "
        "the pointer on a point shows it</text></g>",
        0.5 * (kLeft + kRight), kHeight + 8, unnamed_, unnamed_ == 1 ? " has" : "s have");
  }

  const ScatterChart& chart_;
  std::vector<ScatterPoint> points_;
  std::vector<Box> taken_;
  Axis x_{};
  Axis y_{};
  bool log_y_ = false;
  int unnamed_ = 0;
};

}  // namespace

std::string scatter_chart(const ScatterChart& chart) {
  return ScatterDrawing(chart).svg();
}

}  // namespace scanbench::results
