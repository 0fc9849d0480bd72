// The verb new.
#pragma once

#include "app/context.hpp"

namespace scanbench::app {

void add_new_module(Context& context);

}  // namespace scanbench::app
