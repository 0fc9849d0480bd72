// The verb that draws one scan of a run.
#pragma once

#include "app/context.hpp"

namespace scanbench::app {

/// show
void add_show(Context& context);

}  // namespace scanbench::app
