// The verb run.
#pragma once

#include "app/options.hpp"

namespace scanbench::app {

void add_run(CommandLine& line);

}  // namespace scanbench::app
