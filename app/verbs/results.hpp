// The verbs score and report.
#pragma once

#include "app/options.hpp"

namespace scanbench::app {

void add_score(CommandLine& line);
void add_report(CommandLine& line);

}  // namespace scanbench::app
