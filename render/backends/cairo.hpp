// Scenes as SVG and PDF.
#pragma once

#include <string>
#include <string_view>

#include "render/scene.hpp"

namespace scanbench::render {

/// The whole scene as the bytes of a file. The same scene gives the same bytes in every thread and process.
/// Throws ConfigError if the font (DejaVu Sans) is not installed, InternalError if Cairo fails. The texts of an SVG can
/// be searched; `description` is for readers who hear it.
std::string to_svg(const Scene& scene, std::string_view description = {});
std::string to_pdf(const Scene& scene);

}  // namespace scanbench::render
