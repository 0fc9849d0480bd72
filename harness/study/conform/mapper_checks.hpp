// Checks of mappers.
#pragma once

#include <vector>

#include "core/modules.hpp"
#include "harness/study/conform/check.hpp"

namespace scanbench::study::conform {

/// All of them; each makes its own instances.
const std::vector<Check<Mapper>>& mapper_checks();

}  // namespace scanbench::study::conform
