// A recording: the observed scans and, if they are simulated, the truth; a recorded log may have poses to compare with.
#pragma once

#include <optional>

#include "core/reference_poses.hpp"
#include "core/scan.hpp"
#include "core/truth.hpp"

namespace scanbench {

struct Recording {
  ScanSet observed;
  std::optional<Truth> truth;
  std::optional<ReferencePoses> reference = {};
};

}  // namespace scanbench
