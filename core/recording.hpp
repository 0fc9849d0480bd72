// What is saved and replayed: the observed scans and, if they are simulated, the truth; recorded logs may have poses to
// compare with.
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
