// How a figure is put on paper or a slide: size, letters, colours. The data of the scene stay as they are.
#pragma once

#include <string_view>

#include "core/error.hpp"
#include "render/scene.hpp"

namespace scanbench::render {

enum class Theme {
  paper,   ///< as the figure was made: 8 pt, for a column or a page
  slides,  ///< all measures 1.75 times as large, letters of 14 pt, no higher than a slide
  dark     ///< as paper, light on a dark ground
};

struct OutputStyle {
  Theme theme = Theme::paper;
  double width_mm = 0.0;  ///< 0: the figure's own, wider for slides
  double font_pt = 0.0;   ///< 0: the theme's
  bool title = true;      ///< false: without the title over the panels, which a journal's caption replaces

  bool operator==(const OutputStyle&) const = default;
};

/// What OutputStyle may hold, and the resolution of pictures.
inline constexpr double kLeastWidthMm = 30.0, kMostWidthMm = 1000.0;
inline constexpr double kLeastFontPt = 4.0, kMostFontPt = 36.0;
inline constexpr double kLeastDpi = 36.0, kMostDpi = 1200.0;

/// The scene in this style. A narrower figure has fewer panels in a row.
Scene styled(Scene scene, const OutputStyle& style);

/// "paper", "slides" or "dark". Throws ConfigError for other words.
Theme theme_from(std::string_view name);

}  // namespace scanbench::render
