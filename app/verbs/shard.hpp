// The verb `sweep run`.
#pragma once

#include "app/options.hpp"

namespace scanbench::app {

void add_shard(Verb& sweep);

}  // namespace scanbench::app
