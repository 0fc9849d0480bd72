// The verb `module conform`.
#pragma once

#include "app/options.hpp"

namespace scanbench::app {

void add_conform(Verb& module);

}  // namespace scanbench::app
