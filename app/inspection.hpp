// The verbs check, list, describe.
#pragma once

#include "app/context.hpp"

namespace scanbench::app {

void add_inspection(Context& context);

}  // namespace scanbench::app
