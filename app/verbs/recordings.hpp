// The verbs simulate, export.
#pragma once

#include "app/options.hpp"

namespace scanbench::app {

void add_recordings(CommandLine& line);

}  // namespace scanbench::app
