// Messages about arguments that no verb accepts.
#pragma once

#include <map>
#include <string>

#include "app/verb_description.hpp"

namespace scanbench::app {

/// Arguments that could not be read, and the verb that the user chose.
struct ParseFault {
  Words argv;                                  ///< all arguments, the program's name first
  VerbDescription verb;                        ///< its path is empty if no verb was chosen
  std::map<std::string, std::string> renamed;  ///< options that the verb had, and what is said of each
  bool is_required = false;                    ///< something is missing
  Words missing;                               ///< "FILE: scenario files": options that must be given and are not
  Words extras;                                ///< arguments that the verb does not take
};

/// What is said of the first option of earlier versions among the arguments; empty if there is none.
std::string renamed_option(const ParseFault& fault);

/// What is wrong, with the nearest name; empty if the fault is of another kind.
std::string message_of(const ParseFault& fault);

}  // namespace scanbench::app
