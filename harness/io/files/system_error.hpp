// Errors of the operating system, as opposed to errors in a user's input.
#pragma once

#include "core/error.hpp"

namespace scanbench::io {

/// A failure of the operating system that may not occur elsewhere or later: a full disk, a folder without write
/// permission, too many open files. A cell that fails with it counts as missing, because the failure says nothing about
/// its algorithm.
class SystemError : public ConfigError {
 public:
  using ConfigError::ConfigError;
};

}  // namespace scanbench::io
