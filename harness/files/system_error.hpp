// Errors of the operating system, as opposed to errors of what a user wrote.
#pragma once

#include "core/error.hpp"

namespace scanbench::harness {

/// The operating system refused something that would succeed elsewhere or later: a disk is full, a folder may not be
/// written, too many files are open. A cell that ends so is missing: nothing is known of its algorithm.
class SystemError : public ConfigError {
 public:
  using ConfigError::ConfigError;
};

}  // namespace scanbench::harness
