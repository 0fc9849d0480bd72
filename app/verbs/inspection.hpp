// The verbs check, list, describe.
#pragma once

#include "app/options.hpp"

namespace scanbench::app {

void add_inspection(CommandLine& line);

}  // namespace scanbench::app
