// Checks names before they become parts of paths.
#include "harness/io/files/folder_name.hpp"

#include <cstddef>

#include "core/error.hpp"

namespace scanbench::io {
namespace {

constexpr std::size_t kLongestName = 200;

}  // namespace

bool is_folder_name(std::string_view name) {
  return !name.empty() && name.size() <= kLongestName && name.front() != '.' &&
         name.find_first_of(std::string_view("/\0", 2)) == std::string_view::npos;
}

FolderName check_name(const std::string& what, const std::string& name) {
  if (!is_folder_name(name))
    throw ConfigError("the name of a " + what + " is '" + name +
                      "'; it names a folder: allowed are 1 to 200 characters, no '/', no leading '.'");
  return FolderName(name);
}

}  // namespace scanbench::io
