// The verbs completion and manual: what a shell and `man` need to know of the command line, taken from it.
#pragma once

#include <string>

#include "app/context.hpp"

namespace scanbench::app {

/// A bash script that completes verbs, options, and names of modules; everything else are files.
std::string bash_completion(const Context& context);

/// A manual page in roff.
std::string manual_page(const CLI::App& app);

void add_shell_help(Context& context);

}  // namespace scanbench::app
