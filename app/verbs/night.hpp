// The verb night: results that are kept and judged from night to night.
#pragma once

#include "app/options.hpp"

namespace scanbench::app {

void add_night(CommandLine& line);

}  // namespace scanbench::app
