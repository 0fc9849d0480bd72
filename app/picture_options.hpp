// --style, --width-mm and --dpi of verbs that draw figures.
#pragma once

#include <string>

#include "app/options.hpp"
#include "render/output_style.hpp"

namespace scanbench::app {

/// `style` is the text that theme_from() reads.
void add_picture_options(Verb& verb, std::string& style, render::OutputStyle& look, double& dpi);

}  // namespace scanbench::app
