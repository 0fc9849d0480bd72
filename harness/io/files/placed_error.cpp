// Adds the file's name, line and column to the message of an error.
#include "harness/io/files/placed_error.hpp"

#include <fmt/format.h>

namespace scanbench::io {

void rethrow_in_file(const PlacedError& error, const std::string& file, const std::vector<std::string>& sets) {
  const Mark mark = error.mark();
  if (mark.line == 0 && static_cast<std::size_t>(mark.column) < sets.size())
    throw ConfigError("--set " + sets[static_cast<std::size_t>(mark.column)] + ": " + error.what());
  throw ConfigError(fmt::format("{}:{}:{}: {}", file, mark.line, mark.column, error.what()));
}

}  // namespace scanbench::io
