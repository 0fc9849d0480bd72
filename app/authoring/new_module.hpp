// The verb new.
#pragma once

#include "app/options.hpp"

namespace scanbench::app {

void add_new_module(CommandLine& line);

}  // namespace scanbench::app
