// Declares --format and --json.
#include "app/text_format.hpp"

#include "core/error.hpp"

namespace scanbench::app {

void add_json_flag(Verb& verb, bool& json, const std::string& what) {
  verb.flag("--json", json, "print " + what + " as JSON");
}

void add_format_options(Verb& verb, TextFormat& format, const Words& words, const std::string& what) {
  verb.option("--format", format.name, "what is printed").one_of("format", words).shows_default();
  add_json_flag(verb, format.json, what);
}

std::string format_of(const TextFormat& format) {
  if (!format.json) return format.name;
  if (format.name != "text" && format.name != "json")
    throw ConfigError("--json is short for --format json, and --format is " + format.name);
  return "json";
}

}  // namespace scanbench::app
