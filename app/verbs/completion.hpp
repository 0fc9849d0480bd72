// Scripts that complete the command line in a shell, made from the description of the verbs.
#pragma once

#include <string>

#include "app/options.hpp"

namespace scanbench::app {

/// A script for "bash", "zsh" or "fish". It completes verbs, options, values of a list, and names of modules;
/// everything else are files.
std::string completion_script(const ProgramDescription& text, const std::string& shell);

}  // namespace scanbench::app
