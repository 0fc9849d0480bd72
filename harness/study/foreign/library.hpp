// Shared libraries of modules. Only child processes load them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/study/foreign/source.hpp"

namespace scanbench::study {

/// Throws ForeignFault if the file is not a library of modules, or if its stamp (core/plugin_stamp.hpp) differs from
/// that of this program; the message names what differs. No code of the library runs.
void check_stamp(const std::filesystem::path& library);

/// Loads a library, whose modules then are in the registries of this process, and returns these modules. Loading it a
/// second time returns nothing. Throws ForeignFault for a stamp that differs, a library that the system refuses, and
/// one that changes the floating-point arithmetic of the process: what is linked with -ffast-math flushes small numbers
/// to zero.
std::vector<ForeignModule> load_library(const std::filesystem::path& library);

}  // namespace scanbench::study
