// The verb figures.
#pragma once

#include "app/context.hpp"

namespace scanbench::app {

void add_figures(Context& context);

}  // namespace scanbench::app
