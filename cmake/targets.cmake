# One target per folder, with the same flags for all targets.
set(SCANBENCH_WARNINGS -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror)

function(scanbench_flags target)
  target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR})
  # No contraction of a*b+c, so that recordings are the same bytes on any x86-64.
  target_compile_options(${target} PRIVATE ${SCANBENCH_WARNINGS} -ffp-contract=off)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # g++ 12 warns of overlapping copies inside std::string's own operator+ in optimised builds (GCC bug 105651).
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release,RelWithDebInfo>:-Wno-restrict>)
  endif()
  if(SCANBENCH_SANITIZE)
    if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
      # Instrumented code triggers this warning falsely; the release build keeps it.
      target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)
    endif()
    target_compile_options(${target} PRIVATE -fsanitize=${SCANBENCH_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    # Left out: checks that take a sixth of the compile time. The address sanitizer finds null pointers and accesses
    # beyond an object; x86 reads unaligned numbers.
    target_compile_options(${target} PRIVATE
      -fno-sanitize=null,object-size,vptr,alignment,nonnull-attribute,returns-nonnull-attribute)
    target_link_options(${target} PUBLIC -fsanitize=${SCANBENCH_SANITIZE})
  endif()
endfunction()

# Precompiles the headers that nearly every file includes, once for all targets with the same flags. No file may rely on
# this: each includes what it uses, and -DSCANBENCH_PRECOMPILE=OFF builds without precompiled headers.
# scanbench_precompile(target [more headers...] | target REUSE other)
function(scanbench_precompile target)
  cmake_parse_arguments(arg "" "REUSE" "" ${ARGN})
  if(SCANBENCH_PRECOMPILE)
    if(arg_REUSE)
      target_precompile_headers(${target} REUSE_FROM ${arg_REUSE})
    else()
      target_precompile_headers(${target} PRIVATE <algorithm> <cmath> <filesystem> <functional> <map> <memory> <optional> <span>
                                <string> <vector> <Eigen/Dense> ${arg_UNPARSED_ARGUMENTS})
    endif()
    if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
      # The same false warning under two more names. The build without precompiled headers keeps both.
      target_compile_options(${target} PRIVATE "$<$<CONFIG:Release,RelWithDebInfo>:-Wno-stringop-overflow;-Wno-array-bounds>")
    endif()
  endif()
endfunction()

# scanbench_join(target [BY_FOLDER]): compiles the sources of the target together in batches, so that common headers are
# parsed and common templates instantiated once a batch. A batch has neighbours, with BY_FOLDER of one folder, and at most
# 96 kB of text: 1.2 GB of the compiler's memory. Generated sources and those with flags of their own stay alone. Names in
# unnamed namespaces must be unique within a target, or within a folder.
set(SCANBENCH_BATCH_BYTES 98304)
set(SCANBENCH_ALONE distributions segment_index)  # Boost's templates fill a batch
function(scanbench_join target)
  cmake_parse_arguments(arg "BY_FOLDER" "" "" ${ARGN})
  if(NOT SCANBENCH_JOIN)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "^/.*\\.cpp$")
  list(JOIN SCANBENCH_ALONE "|" alone)
  list(FILTER sources EXCLUDE REGEX "_kernels\\.cpp$|/(${alone})\\.cpp$|^${PROJECT_BINARY_DIR}/")
  list(SORT sources)
  set(batch 0)
  set(bytes 0)
  foreach(source ${sources})
    file(SIZE ${source} size)
    math(EXPR bytes "${bytes} + ${size}")
    get_filename_component(folder ${source} DIRECTORY)
    if(bytes GREATER SCANBENCH_BATCH_BYTES OR (arg_BY_FOLDER AND NOT folder STREQUAL last_folder))
      math(EXPR batch "${batch} + 1")
      set(bytes ${size})
    endif()
    set(last_folder ${folder})
    set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP batch${batch})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # g++ takes joined sources for headers, in which members of types in unnamed namespaces would be a mistake.
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif()
endfunction()

# scanbench_library(name [OBJECT] [FOLDER folder] [SPEED O1|O2] [REUSE other | PRECOMPILE header...]): target
# scanbench_<name> from all files of the folder. The folder is `name` unless FOLDER is given. SPEED replaces -O3 of the
# release build where compiling quickly is worth more than running quickly. The target reuses the precompiled headers of
# another target with the same SPEED, or precompiles additional ones.
function(scanbench_library name)
  cmake_parse_arguments(arg "OBJECT" "FOLDER;REUSE;SPEED" "PRECOMPILE" ${ARGN})
  if(NOT arg_FOLDER)
    set(arg_FOLDER ${name})
  endif()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${arg_FOLDER}/*.cpp)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${arg_FOLDER}/*.hpp)
  if(arg_OBJECT)
    add_library(scanbench_${name} OBJECT ${sources})
  else()
    add_library(scanbench_${name} STATIC ${sources})
  endif()
  target_sources(scanbench_${name} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${headers})
  set_target_properties(scanbench_${name} PROPERTIES VERIFY_INTERFACE_HEADER_SETS ON)
  scanbench_flags(scanbench_${name})
  if(arg_SPEED)
    target_compile_options(scanbench_${name} PRIVATE $<$<CONFIG:Release>:-${arg_SPEED}>)
  endif()
  if(arg_REUSE)
    scanbench_precompile(scanbench_${name} REUSE scanbench_${arg_REUSE})
  else()
    scanbench_precompile(scanbench_${name} ${arg_PRECOMPILE})
  endif()
  scanbench_join(scanbench_${name})
endfunction()

# scanbench_executable(name FOLDER folder | SOURCES file... [ROOMS name...]): links every module, or only the named
# folders. Files that register themselves must be linked completely, so algorithms are linked as objects, and metrics,
# render and sim as whole archives.
function(scanbench_executable name)
  cmake_parse_arguments(arg "" "FOLDER" "SOURCES;ROOMS" ${ARGN})
  if(NOT arg_ROOMS)
    # Ordered from the top layer down, so that no whole archive must be listed twice.
    set(arg_ROOMS algorithms nightly player gallery film pages tables figures document analysis sweep execute store scenario
                  catalog exchange yaml conform foreign
                  process files sim metrics render core)
  endif()
  if(arg_FOLDER)
    file(GLOB_RECURSE arg_SOURCES CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${arg_FOLDER}/*.cpp)
  endif()
  add_executable(${name} ${arg_SOURCES})
  scanbench_flags(${name})
  # The linker's build id is a hash of everything, so of the commit too, which the version of the code leaves out.
  target_link_options(${name} PRIVATE LINKER:--build-id=none)
  # Symbols are resolved at the start and not again in each of a run's child processes.
  target_link_options(${name} PRIVATE LINKER:-z,now)
  list(TRANSFORM arg_ROOMS PREPEND scanbench_ OUTPUT_VARIABLE rooms)
  target_link_libraries(${name} PRIVATE ${rooms})
  set_target_properties(${name} PROPERTIES LINK_LIBRARY_OVERRIDE
    "WHOLE_ARCHIVE,scanbench_sim,scanbench_metrics,scanbench_render")
endfunction()

# scanbench_kernels(target folder...): compiles the files *_kernels.cpp of the folders, which the target contains for any
# x86-64, a second time for AVX2, in the namespace v3 instead of baseline. The program selects one at run time. No
# product and sum are contracted, so that both give the same bytes.
function(scanbench_kernels target)
  list(TRANSFORM ARGN REPLACE "(.+)" "${PROJECT_SOURCE_DIR}/\\1/*_kernels.cpp" OUTPUT_VARIABLE patterns)
  file(GLOB sources CONFIGURE_DEPENDS ${patterns})
  add_library(${target}_v3 OBJECT ${sources})
  scanbench_flags(${target}_v3)
  target_compile_definitions(${target}_v3 PRIVATE SCANBENCH_ISA=v3)
  target_compile_options(${target}_v3 PRIVATE -mavx2)
  # An object library does not hand on the objects of another one, so its users add them.
  get_target_property(type ${target} TYPE)
  if(type STREQUAL OBJECT_LIBRARY)
    target_sources(${target} INTERFACE $<TARGET_OBJECTS:${target}_v3>)
  else()
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${target}_v3>)
  endif()
  # Precompiled headers contain inline functions, of which the linker would keep only one build.
  set_source_files_properties(${sources} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
endfunction()
