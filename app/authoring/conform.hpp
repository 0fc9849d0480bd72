// The verb conform.
#pragma once

#include "app/options.hpp"

namespace scanbench::app {

void add_conform(CommandLine& line);

}  // namespace scanbench::app
