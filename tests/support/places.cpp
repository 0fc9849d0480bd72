// Paths from the build's definitions and the environment.
#include "tests/support/places.hpp"

#include <cstdlib>

namespace scanbench::places {

std::filesystem::path source_dir() {
  return SCANBENCH_SOURCE_DIR;
}

std::filesystem::path program() {
  return SCANBENCH_PROGRAM;
}

std::filesystem::path plugin(const std::string& name) {
  return std::filesystem::path(SCANBENCH_PLUGINS) / ("lib" + name + ".so");
}

std::filesystem::path data_dir() {
  const char* data = std::getenv("SCANBENCH_DATA");
  return data != nullptr ? std::filesystem::path(data) : source_dir() / "../shared/data";
}

}  // namespace scanbench::places
