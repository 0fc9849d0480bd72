// The verb `module new`.
#pragma once

#include "app/options.hpp"

namespace scanbench::app {

void add_new_module(Verb& module);

}  // namespace scanbench::app
