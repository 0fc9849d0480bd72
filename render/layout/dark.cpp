// Turns lightness over in the HSL model, where hue and saturation stay.
#include "render/layout/dark.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <variant>

namespace scanbench::render {
namespace {

constexpr double kBrightest = 240.0;                        // what black becomes; pure white on a dark ground dazzles
constexpr double kTintChroma = 38.0, kMethodChroma = 76.0;  // of 255

}  // namespace

Color dark_color(Color color) {
  // With L = (max + min) / 2, the map c -> c + (1 - 2 L) keeps the differences of the channels, thus hue and chroma,
  // and gives the lightness 1 - L.
  const auto [low, high] = std::minmax({color.r, color.g, color.b});
  const int over = 255 - low - high;
  // A light colour of a method must stay light to be seen on the ground; a tint, which has little chroma, is a
  // background and becomes dark.
  const double strength = std::clamp((high - low - kTintChroma) / (kMethodChroma - kTintChroma), 0.0, 1.0);
  const double shift = over >= 0 ? over : (1.0 - strength) * over;
  const auto turned = [shift](std::uint8_t channel, std::uint8_t ground) {
    const double share = (channel + shift) / 255.0;
    return static_cast<std::uint8_t>(std::lround(ground + share * (kBrightest - ground)));
  };
  return {turned(color.r, kDarkGround.r), turned(color.g, kDarkGround.g), turned(color.b, kDarkGround.b)};
}

void darken(std::vector<Shape>& shapes, double width, double height) {
  for (Shape& shape : shapes) {
    if (auto* stroke = std::get_if<StrokeShape>(&shape.what)) {
      stroke->stroke.color = dark_color(stroke->stroke.color);
    } else if (auto* text = std::get_if<TextShape>(&shape.what)) {
      text->color = dark_color(text->color);
      text->halo_color = dark_color(text->halo_color);
    } else if (auto* dots = std::get_if<DotsShape>(&shape.what)) {
      dots->color = dark_color(dots->color);
    } else if (auto* fill = std::get_if<FillShape>(&shape.what)) {
      fill->color = dark_color(fill->color);
    }
  }
  FillShape ground{.points = {{-1, -1}, {width + 1, -1}, {width + 1, height + 1}, {-1, height + 1}},
                   .color = kDarkGround};
  ground.end_contour();
  shapes.emplace_back().what.emplace<FillShape>(std::move(ground));
  std::rotate(shapes.begin(), shapes.end() - 1, shapes.end());
}

}  // namespace scanbench::render
