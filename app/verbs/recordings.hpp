// The verbs simulate, export.
#pragma once

#include "app/options.hpp"

namespace scanbench::app {

void add_simulate(CommandLine& line);
void add_export(CommandLine& line);

}  // namespace scanbench::app
