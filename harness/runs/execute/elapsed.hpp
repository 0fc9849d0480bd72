// The time that a piece of work took.
#pragma once

#include <chrono>

namespace scanbench::runs {

/// Seconds of wall-clock time since `start`.
inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace scanbench::runs
