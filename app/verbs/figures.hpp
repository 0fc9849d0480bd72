// The verb figures.
#pragma once

#include "app/options.hpp"

namespace scanbench::app {

void add_figures(CommandLine& line);

}  // namespace scanbench::app
