// The verb conform.
#pragma once

#include "app/context.hpp"

namespace scanbench::app {

void add_conform(Context& context);

}  // namespace scanbench::app
