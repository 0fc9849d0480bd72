// The words of an SVG figure. Its letters are outlines, which look the same everywhere but cannot be searched.
#pragma once

#include <string>
#include <string_view>

#include "render/layout/layout.hpp"

namespace scanbench::render {

/// The SVG with a <title> and a <desc> for readers who hear it, and with its texts as transparent <text> over their
/// outlines, so that they can be searched, selected and copied. Empty title or description: none.
std::string with_words(std::string svg, const Layout& layout, std::string_view title, std::string_view description);

}  // namespace scanbench::render
