// The verbs of the program, in the drawers of its help.
#pragma once

#include "app/options.hpp"

namespace scanbench::app {

/// Adds every verb, and the names that verbs had in earlier versions.
void add_drawers(CommandLine& line);

}  // namespace scanbench::app
