// Checks of the values of options, with messages that say what was found and what is allowed.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace scanbench::app {

/// Refuses what is no whole number from `low` to `high`: "'0' is no number of threads; allowed: a whole number 1 .. 9".
CLI::Validator whole_number(const std::string& what, int low, int high);

/// Refuses what is no number from `low` to `high`: "'9e9' is no resolution in dpi; allowed: 36 .. 1200".
CLI::Validator number(const std::string& what, double low, double high);

/// Refuses what is none of these words: "'xml' is no format; allowed: carmen, csv".
/// The shell completion reads the words from its description, {carmen,csv}.
CLI::Validator one_of(const std::string& what, const std::vector<std::string>& words);

}  // namespace scanbench::app
