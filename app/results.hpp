// The verbs score and report.
#pragma once

#include "app/context.hpp"

namespace scanbench::app {

void add_results(Context& context);

}  // namespace scanbench::app
