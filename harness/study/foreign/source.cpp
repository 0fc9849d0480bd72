// Construction of sources of foreign modules, and their names for messages.
#include "harness/study/foreign/source.hpp"

namespace scanbench::study {

ForeignSource::ForeignSource() = default;
ForeignSource::ForeignSource(const ForeignSource&) = default;
ForeignSource::ForeignSource(ForeignSource&&) noexcept = default;
ForeignSource& ForeignSource::operator=(const ForeignSource&) = default;
ForeignSource& ForeignSource::operator=(ForeignSource&&) noexcept = default;
ForeignSource::~ForeignSource() = default;

std::string ForeignSource::text() const {
  if (program.empty()) return library.filename().string();
  std::string all;
  for (const std::string& argument : program) {
    const bool is_path = argument.starts_with('/');
    all += (all.empty() ? "" : " ") + (is_path ? std::filesystem::path(argument).filename().string() : argument);
  }
  return all;
}

}  // namespace scanbench::study
