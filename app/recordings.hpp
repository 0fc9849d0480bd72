// The verbs simulate, export.
#pragma once

#include "app/context.hpp"

namespace scanbench::app {

void add_recordings(Context& context);

}  // namespace scanbench::app
