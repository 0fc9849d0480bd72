// Checks of what a module of any kind says of itself.
#pragma once

#include <vector>

#include "core/params.hpp"
#include "core/registry.hpp"
#include "harness/study/conform/check.hpp"

namespace scanbench::study::conform {

/// Names, units, texts.
void check_description(const ModuleInfo& info, const std::vector<ParamSpec>& params, Findings& findings);

}  // namespace scanbench::study::conform
