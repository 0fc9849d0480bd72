# Writes the texts of module templates into a header: cmake -DSOURCE_DIR=DIR -DTEMPLATES=KIND=FILE,... -DOUTPUT=FILE -P
# this file. A text must not contain )text".
string(REPLACE "," ";" templates "${TEMPLATES}")
set(header "// Written by cmake/embed_templates.cmake: the text of an example of each kind of module.
#pragma once

#include <string_view>

namespace scanbench::app {

struct ModuleTemplate {
  std::string_view kind;
  std::string_view text;
};

inline constexpr ModuleTemplate kModuleTemplates[] = {
")
foreach(template ${templates})
  string(REGEX MATCH "^([a-z]+)=(.+)$" matched "${template}")
  set(kind ${CMAKE_MATCH_1})
  set(path ${CMAKE_MATCH_2})
  file(READ ${SOURCE_DIR}/${path} text)
  string(APPEND header "    {\"${kind}\", R\"text(${text})text\"},\n")
endforeach()
string(APPEND header "};

}  // namespace scanbench::app
")
file(WRITE ${OUTPUT} "${header}")
