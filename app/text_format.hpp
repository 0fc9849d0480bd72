// --format and --json of verbs that print a text.
#pragma once

#include <string>

#include "app/options.hpp"

namespace scanbench::app {

struct TextFormat {
  std::string name = "text";
  bool json = false;
};

/// --json, as every verb has it that can print JSON.
void add_json_flag(Verb& verb, bool& json, const std::string& what);

/// --format, one of `words`, and --json, which is short for --format json.
void add_format_options(Verb& verb, TextFormat& format, const Words& words, const std::string& what);

/// The chosen word. Throws ConfigError if --json contradicts --format.
std::string format_of(const TextFormat& format);

}  // namespace scanbench::app
