// The scans that `scanbench module conform` uses, for tests.
#pragma once

#include "core/special_values.hpp"
#include "harness/study/conform/scenes.hpp"

namespace scanbench::support {

using namespace scanbench::study::conform;
using scanbench::kInf;
using scanbench::kNaN;

}  // namespace scanbench::support
