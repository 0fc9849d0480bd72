// The verb `sweep unpack`.
#pragma once

#include "app/options.hpp"

namespace scanbench::app {

void add_unpack(Verb& sweep);

}  // namespace scanbench::app
