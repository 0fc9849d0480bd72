// The verbs score and report.
#pragma once

#include "app/options.hpp"

namespace scanbench::app {

void add_results(CommandLine& line);

}  // namespace scanbench::app
