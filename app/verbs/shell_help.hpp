// The verbs completion and manual, which print what a shell and `man` need to know of the command line; and build and
// test, which the script ./scanbench does.
#pragma once

#include <string>

#include "app/options.hpp"

namespace scanbench::app {

/// A bash script that completes verbs, options, and names of modules; everything else are files.
std::string bash_completion(const ProgramDescription& text);

/// A manual page in roff.
std::string manual_page(const ProgramDescription& text);

void add_shell_help(CommandLine& line);

}  // namespace scanbench::app
