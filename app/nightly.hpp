// The verbs nightly, accept and store: results that are kept from night to night.
#pragma once

#include "app/context.hpp"

namespace scanbench::app {

void add_nightly(Context& context);

}  // namespace scanbench::app
