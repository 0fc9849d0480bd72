// Why a figure cannot be drawn.
#pragma once

#include <string>

#include "render/figure.hpp"

namespace scanbench::results {

/// Why a figure draws nothing of this input: the trace rows that nothing kept, or its own reason.
std::string why_not_drawn(const render::Figure& figure, const render::FigureInput& input);

}  // namespace scanbench::results
