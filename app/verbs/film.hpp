// The verb film.
#pragma once

#include "app/options.hpp"

namespace scanbench::app {

void add_film(CommandLine& line);

}  // namespace scanbench::app
