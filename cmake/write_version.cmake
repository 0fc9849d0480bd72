# Writes the version header. The commit is the last one that changed the code: one of a baseline or of a page changes no
# program, and must link none again. That of a tree with local changes gets "-dirty-" and a hash of the code, so that two
# such programs can be distinguished. Without Git it is "unknown-" with that hash.
set(code core sim algorithms metrics render harness app examples/plugin cmake CMakeLists.txt)
execute_process(COMMAND git -C ${SOURCE_DIR} log -1 --format=%H -- ${code} OUTPUT_VARIABLE commit
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
set(mark "")
if(failed OR NOT commit)
  set(commit "unknown")
  set(mark "-")
else()
  execute_process(COMMAND git -C ${SOURCE_DIR} status --porcelain --untracked-files=all -- ${code}
                  OUTPUT_VARIABLE changes OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(changes)
    set(mark "-dirty-")
  endif()
endif()
if(mark)
  set(hashes "")
  foreach(part ${code})
    if(IS_DIRECTORY ${SOURCE_DIR}/${part})
      file(GLOB_RECURSE files RELATIVE ${SOURCE_DIR} ${SOURCE_DIR}/${part}/*.cpp ${SOURCE_DIR}/${part}/*.hpp
           ${SOURCE_DIR}/${part}/*.cmake ${SOURCE_DIR}/${part}/*.cpp.in)
    elseif(EXISTS ${SOURCE_DIR}/${part})
      set(files ${part})
    else()
      set(files "")
    endif()
    list(SORT files)
    foreach(name ${files})
      file(SHA256 ${SOURCE_DIR}/${name} hash)
      string(APPEND hashes "${name} ${hash}\n")
    endforeach()
  endforeach()
  string(SHA256 hash "${hashes}")
  string(SUBSTRING ${hash} 0 12 hash)
  string(APPEND commit "${mark}${hash}")
endif()
set(text "#pragma once

namespace scanbench::version {
inline constexpr const char* kVersion = \"${VERSION}\";
// Volatile: the executable then has it in one piece, which the version of the code leaves out.
inline const char* const volatile kCommit = \"${commit}\";
inline constexpr const char* kCompiler = \"${COMPILER}\";
inline constexpr const char* kBuildType = \"${BUILD_TYPE}\";
inline constexpr const char* kFlags = \"${FLAGS}\";
inline constexpr const char* kLibraries = \"${LIBRARIES}\";
}  // namespace scanbench::version
")
# The stamp of shared libraries of modules has the version and a hash of the headers that they include.
file(GLOB_RECURSE headers RELATIVE ${SOURCE_DIR} ${SOURCE_DIR}/core/*.hpp)
list(SORT headers)
set(hashes "")
foreach(name ${headers})
  file(SHA256 ${SOURCE_DIR}/${name} hash)
  string(APPEND hashes "${name} ${hash}\n")
endforeach()
string(SHA256 hash "${hashes}")
string(SUBSTRING ${hash} 0 12 hash)
set(stamp "#pragma once

#define SCANBENCH_STAMP_VERSION \"${VERSION}\"
#define SCANBENCH_STAMP_HEADERS \"${hash}\"
")
get_filename_component(folder ${OUTPUT} DIRECTORY)
set(old "")
if(EXISTS ${folder}/scanbench_stamp.hpp)
  file(READ ${folder}/scanbench_stamp.hpp old)
endif()
if(NOT old STREQUAL stamp)
  file(WRITE ${folder}/scanbench_stamp.hpp "${stamp}")
endif()

set(old "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT old STREQUAL text)
  file(WRITE ${OUTPUT} "${text}")
endif()
