// The paths of the source tree, the program and recorded data.
#pragma once

#include <filesystem>
#include <string>

namespace scanbench::places {

std::filesystem::path source_dir();
std::filesystem::path program();

/// A shared library of modules that the tests build, by its name.
std::filesystem::path plugin(const std::string& name);

/// The folder of recorded data, which need not exist: the environment's SCANBENCH_DATA, or beside the source tree.
std::filesystem::path data_dir();

}  // namespace scanbench::places
