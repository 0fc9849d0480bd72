// Draws a scan and its lines as inline SVG of a few kilobytes: whole numbers as coordinates, one path per kind.
#include "harness/results/document/scan_sketch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/special_values.hpp"
#include "harness/results/document/plain_text.hpp"

namespace scanbench::results {
namespace {

// The frame, in units of half a pixel.
constexpr double kSketchWidth = 480.0;
constexpr double kSketchHeight = 360.0;
constexpr double kSketchMargin = 14.0;

constexpr std::array<std::pair<const char*, const char*>, 6> kKinds{{{"right", "right"},
                                                                     {"split", "split"},
                                                                     {"false", "false"},
                                                                     {"missed", "missed"},
                                                                     {"unjudged", "too short to judge"},
                                                                     {"small", "wall too small to judge"}}};

/// From metres to the frame: one scale for both axes, y up.
class View {
 public:
  explicit View(const ScanSketch& sketch) {
    for (const Vec2& p : sketch.points) include(p);
    for (const auto& line : sketch.lines) {
      include(line.segment.a);
      include(line.segment.b);
    }
    scale_ = std::min((kSketchWidth - 2 * kSketchMargin) / std::max(high_.x() - low_.x(), 1e-3),
                      (kSketchHeight - 2 * kSketchMargin) / std::max(high_.y() - low_.y(), 1e-3));
  }

  std::string place(const Vec2& p) const {
    const Vec2 from_center = scale_ * (p - 0.5 * (low_ + high_));
    return fmt::format("{:.0f} {:.0f}", 0.5 * kSketchWidth + from_center.x(), 0.5 * kSketchHeight - from_center.y());
  }

 private:
  void include(const Vec2& p) {
    if (!p.allFinite()) return;
    low_ = low_.cwiseMin(p);
    high_ = high_.cwiseMax(p);
  }

  Vec2 low_ = Vec2::Zero();  // the sensor is in the picture
  Vec2 high_ = Vec2::Zero();
  double scale_ = 1.0;
};

}  // namespace

std::string scan_sketch(const ScanSketch& sketch) {
  const View view(sketch);
  std::string points;
  for (const Vec2& p : sketch.points)
    if (p.allFinite()) points += "M" + view.place(p) + "h0";
  std::array<std::string, kKinds.size()> paths;
  for (const auto& [segment, kind] : sketch.lines)
    if (segment.a.allFinite() && segment.b.allFinite())
      paths[static_cast<std::size_t>(kind)] += "M" + view.place(segment.a) + "L" + view.place(segment.b);
  std::string lines;
  for (std::size_t kind = 0; kind < kKinds.size(); ++kind)
    if (!paths[kind].empty()) lines += fmt::format(R"(<path class="{}" d="{}"/>)", kKinds[kind].first, paths[kind]);
  return fmt::format(
      "<svg class=\"scan\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\"><path "
      "class=\"points\" d=\"{}\"/>{}<path class=\"sensor\" d=\"M{}m-7 -8l14 8l-14 8z\"/></svg>",
      kSketchWidth, kSketchHeight, html_escaped(plain_line(sketch.label)), points, lines, view.place(Vec2::Zero()));
}

std::string scan_sketch_key() {
  std::string out = "<p class=\"key\">";
  for (const auto& [kind, name] : kKinds)
    out += fmt::format(R"(<span><svg class="scan" viewBox="0 0 64 12"><path class="{}" d="M2 6H62"/></svg> {}</span>)",
                       kind, name);
  return out + "<span>▶ sensor</span></p>\n";
}

}  // namespace scanbench::results
