// The verb sweep, which runs a suite on several machines: plan, run, status, merge, submit, unpack.
#pragma once

#include "app/options.hpp"

namespace scanbench::app {

void add_sweep(CommandLine& line);

}  // namespace scanbench::app
