// Errors with a place in an input file: line and column.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace scanbench::io {

/// 1-based. Line 0 marks a node from a `--set` override instead of the file; column is then the override's 0-based
/// number.
struct Mark {
  int line = 0;
  int column = 0;
};

/// An error inside a file whose name only the caller knows. in_file() adds the name and throws a ConfigError.
class PlacedError : public ConfigError {
 public:
  PlacedError(Mark mark, const std::string& message) : ConfigError(message), mark_(mark) {}
  Mark mark() const { return mark_; }

 private:
  Mark mark_;
};

/// Throws the error as a ConfigError with `file:line:col: ` in front, or `--set key=value: ` for an override.
[[noreturn]] void rethrow_in_file(const PlacedError& error, const std::string& file,
                                  const std::vector<std::string>& sets);

/// Runs `work` and puts the file's name in front of its PlacedErrors.
template <class Work>
auto in_file(const std::string& file, const std::vector<std::string>& sets, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const PlacedError& error) {
    rethrow_in_file(error, file, sets);
  }
}

}  // namespace scanbench::io
