// The verbs check, list, describe.
#pragma once

#include "app/options.hpp"

namespace scanbench::app {

void add_check(CommandLine& line);
void add_list(CommandLine& line);
void add_describe(CommandLine& line);

}  // namespace scanbench::app
