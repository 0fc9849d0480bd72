// Turns a failed assertion into an exception.
#include "core/error.hpp"

namespace scanbench {

void fail_assertion(const char* condition, const char* file, int line) {
  throw InternalError(std::string(file) + ":" + std::to_string(line) + ": assertion failed: " + condition);
}

}  // namespace scanbench
