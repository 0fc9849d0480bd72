// A recording: the observed scans and, if they are simulated, the truth.
#pragma once

#include <optional>

#include "core/scan.hpp"
#include "core/truth.hpp"

namespace scanbench {

struct Recording {
  ScanSet observed;
  std::optional<Truth> truth;
};

}  // namespace scanbench
