// The verb that draws one scan of a run.
#pragma once

#include "app/options.hpp"

namespace scanbench::app {

/// show
void add_show(CommandLine& line);

}  // namespace scanbench::app
