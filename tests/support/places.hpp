// Where the tests find the source tree, the program and recorded data.
#pragma once

#include <filesystem>

namespace scanbench::places {

std::filesystem::path source_dir();
std::filesystem::path program();

/// Where recorded logs may be: the environment's SCANBENCH_DATA, or beside the source tree.
std::filesystem::path data_dir();

}  // namespace scanbench::places
