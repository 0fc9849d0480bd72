// Exceptions: ConfigError for errors that a user can correct, InternalError for a bug of this program.
#pragma once

#include <stdexcept>
#include <string>

namespace scanbench {

/// A wrong file, value or argument. The message names the place (file:line:col if there is one), what was found and
/// what is allowed. Caught once, in app/, which exits with 2.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A value that a parameter does not accept. The check of the bounds throws it without knowing any file; the reader of
/// the file adds the place in front.
class ParamError : public ConfigError {
 public:
  ParamError(std::string param, const std::string& message) : ConfigError(message), param_(std::move(param)) {}
  const std::string& param() const { return param_; }

 private:
  std::string param_;
};

/// A bug of this program. Caught in app/, which exits with 70.
class InternalError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

[[noreturn]] void fail_assertion(const char* condition, const char* file, int line);

/// A module's result breaks the contract of its interface: labels of another length, numbers that are not finite.
class InvalidResult : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace scanbench

/// Checks a condition that only a bug of this program can break. Active in every build: none is in an inner loop.
#define SCANBENCH_ASSERT(condition) \
  (static_cast<bool>(condition) ? void(0) : ::scanbench::fail_assertion(#condition, __FILE__, __LINE__))
