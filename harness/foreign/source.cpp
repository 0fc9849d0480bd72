// Names of foreign modules for messages.
#include "harness/foreign/source.hpp"

namespace scanbench::harness {

std::string ForeignSource::text() const {
  if (program.empty()) return library.filename().string();
  std::string all;
  for (const std::string& argument : program) {
    const bool is_path = argument.starts_with('/');
    all += (all.empty() ? "" : " ") + (is_path ? std::filesystem::path(argument).filename().string() : argument);
  }
  return all;
}

}  // namespace scanbench::harness
