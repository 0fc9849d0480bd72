// What the program's help, its manual page, completion and its messages know of verbs and options.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace scanbench::app {

using Words = std::vector<std::string>;

/// What a shell and `man` need to know of an option, in the order of the help.
struct OptionDescription {
  Words short_names;  ///< "-o"
  Words long_names;   ///< "--out"; a positional argument has neither
  std::string name;   ///< "RUN", "--out"
  std::string help;
  std::string default_value;  ///< empty if the help shows none
  bool has_value = true;      ///< false: a flag
  Words choices;              ///< of one_of()
  std::function<Words()> words;
};

struct VerbDescription {
  std::string name;  ///< "run", "plan"
  std::string path;  ///< as it is typed: "run", "sweep plan"
  std::string help;
  std::string details;
  std::vector<OptionDescription> options;
  std::vector<VerbDescription> verbs;
};

}  // namespace scanbench::app
