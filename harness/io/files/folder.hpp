// The contents of a folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace scanbench::io {

/// Names of the files and folders in it, in order; those before the first that cannot be read. None if it does not
/// exist.
std::vector<std::string> names_in(const std::filesystem::path& folder);

}  // namespace scanbench::io
