// The verb compare, which judges one run against another.
#pragma once

#include "app/options.hpp"

namespace scanbench::app {

void add_compare(CommandLine& line);

}  // namespace scanbench::app
