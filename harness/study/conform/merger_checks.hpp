// Checks of segment mergers.
#pragma once

#include <vector>

#include "core/modules.hpp"
#include "harness/study/conform/check.hpp"

namespace scanbench::study::conform {

/// All of them; each makes its own instances.
const std::vector<Check<SegmentMerger>>& merger_checks();

}  // namespace scanbench::study::conform
