// The verb compare, which judges one run against another.
#pragma once

#include "app/context.hpp"

namespace scanbench::app {

void add_compare(Context& context);

}  // namespace scanbench::app
