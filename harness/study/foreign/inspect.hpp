// Asks programs and libraries for their modules, in child processes with limits.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/params.hpp"
#include "harness/study/foreign/source.hpp"

namespace scanbench::study {

/// Starts the program, under bubblewrap if `sandbox`, asks it for its description and fills in source.module. Programs
/// are asked once per process and bytes of their files. Throws ForeignFault, with the end of what the program printed.
void inspect_program(ForeignSource& source, bool sandbox);

/// The sources of the modules in a library. It is loaded in a child process only. Throws ForeignFault.
std::vector<ForeignSource> inspect_library(const std::filesystem::path& library);

}  // namespace scanbench::study
