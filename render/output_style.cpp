// Scales a scene's measures on paper and chooses the number of panels in a row.
#include "render/output_style.hpp"

#include <algorithm>
#include <string>
#include <type_traits>
#include <variant>

namespace scanbench::render {
namespace {

constexpr double kMmPerInch = 25.4;
constexpr double kSlideScale = 1.75;    // of all measures: a double column becomes 12.5 in of a slide's 13.3 in
constexpr double kSlideHeightIn = 6.3;  // of a slide's 7.5 in, with room for its heading
constexpr double kPanelWidthEm = 13.0;  // least width of a panel with its tick labels

void scale(Stroke& stroke, double factor) {
  stroke.width_pt *= factor;
}

/// Widths and lengths on paper of one item.
void scale(Item& item, double factor) {
  std::visit(
      [factor](auto& i) {
        using T = std::decay_t<decltype(i)>;
        if constexpr (requires { i.stroke; }) scale(i.stroke, factor);
        if constexpr (requires { i.size_pt; }) i.size_pt *= factor;
        if constexpr (requires { i.offset_pt; }) i.offset_pt *= factor;
        if constexpr (requires { i.length_pt; }) i.length_pt *= factor;
        if constexpr (requires { i.cap_pt; }) i.cap_pt *= factor;
        if constexpr (std::is_same_v<T, Polygon>)
          if (i.outline) scale(*i.outline, factor);
      },
      item);
}

void scale_marks(Scene& scene, double factor) {
  for (Panel& panel : scene.panels)
    for (Item& item : panel.items) scale(item, factor);
  for (LegendEntry& entry : scene.legend) {
    if (entry.stroke) scale(*entry.stroke, factor);
    entry.marker_size_pt *= factor;
  }
}

/// The least width of a panel [em], with the room for its letters.
double panel_width_em(const Scene& scene) {
  double letters = 0.0;
  for (const Panel& panel : scene.panels) letters = std::max(letters, panel.room.left + panel.room.right);
  return kPanelWidthEm + letters;
}

int own_columns(const Scene& scene) {
  return scene.columns > 0 ? scene.columns : scene.panels.size() == 4 ? 2 : 3;
}

}  // namespace

Scene styled(Scene scene, const OutputStyle& style) {
  const bool slides = style.theme == Theme::slides;
  if (!style.title) scene.title.clear();
  scene.dark = style.theme == Theme::dark;
  const double own_width_in = scene.width_in, own_font_pt = scene.font_pt;
  if (slides) {
    scene.width_in *= kSlideScale;
    scene.font_pt *= kSlideScale;
    scene.max_height_in = kSlideHeightIn;
  }
  if (style.width_mm > 0) scene.width_in = style.width_mm / kMmPerInch;
  if (style.font_pt > 0) scene.font_pt = style.font_pt;
  if (slides) scale_marks(scene, kSlideScale);
  if (scene.height_in > 0) scene.height_in *= scene.width_in / own_width_in;
  if (scene.width_in != own_width_in || scene.font_pt != own_font_pt) {
    const int fit = static_cast<int>(72.0 * scene.width_in / (panel_width_em(scene) * scene.font_pt));
    scene.columns = std::clamp(fit, 1, own_columns(scene));
  }
  return scene;
}

Theme theme_from(std::string_view name) {
  if (name == "paper") return Theme::paper;
  if (name == "slides") return Theme::slides;
  if (name == "dark") return Theme::dark;
  throw ConfigError("'" + std::string(name) + "' is not a style; allowed: paper, slides, dark");
}

}  // namespace scanbench::render
