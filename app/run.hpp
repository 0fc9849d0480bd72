// The verb run.
#pragma once

#include "app/context.hpp"

namespace scanbench::app {

void add_run(Context& context);

}  // namespace scanbench::app
