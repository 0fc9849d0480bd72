// Declares the options for the look of pictures.
#include "app/picture_options.hpp"

namespace scanbench::app {

void add_picture_options(Verb& verb, std::string& style, render::OutputStyle& look, double& dpi) {
  verb.option("--width-mm", look.width_mm,
              "width on paper (default: each figure's own, 88.9 mm for a column or 181.9 mm for two)")
      .number("width in mm", render::kLeastWidthMm, render::kMostWidthMm);
  verb.option("--dpi", dpi, "resolution of PNG")
      .number("resolution in dpi", render::kLeastDpi, render::kMostDpi)
      .shows_default();
  verb.option("--style", style, "paper; slides: larger letters and wider lines; dark: as paper, on a dark ground")
      .one_of("style", {"paper", "slides", "dark"})
      .shows_default();
}

}  // namespace scanbench::app
