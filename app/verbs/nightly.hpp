// The verbs nightly, accept and store: results that are kept from night to night.
#pragma once

#include "app/options.hpp"

namespace scanbench::app {

void add_nightly(CommandLine& line);

}  // namespace scanbench::app
