// The verbs completion and manual, which print what a shell and `man` need to know of the command line; and build, test
// and peers, which the script ./scanbench does.
#pragma once

#include <string>

#include "app/options.hpp"

namespace scanbench::app {

/// A manual page in roff.
std::string manual_page(const ProgramDescription& text);

void add_shell_help(CommandLine& line);

}  // namespace scanbench::app
