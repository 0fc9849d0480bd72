# Writes the version and the commit of the tree to a header at build time. The file is written only when it changes, so
# that an unchanged tree links nothing again. One source file of harness/runs/store includes it.
string(TOUPPER "${CMAKE_BUILD_TYPE}" config)
set(versions "")
foreach(package Eigen3 fmt box2d yaml-cpp nlohmann_json CLI11 nanoflann)
  if(${package}_VERSION)
    list(APPEND versions "${package} ${${package}_VERSION}")
  endif()
endforeach()
list(APPEND versions "OpenSSL ${OPENSSL_VERSION}" "zlib ${ZLIB_VERSION_STRING}" "libpng ${PNG_VERSION_STRING}" "osmesa ${OSMESA_VERSION}" "cairo ${CAIRO_cairo_VERSION}")
list(JOIN versions "," versions)
add_custom_target(scanbench_version
  COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${PROJECT_SOURCE_DIR} -DVERSION=${PROJECT_VERSION}
          -DBUILD_TYPE=${CMAKE_BUILD_TYPE} "-DCOMPILER=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}"
          "-DFLAGS=${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${config}}" "-DLIBRARIES=${versions}"
          -DOUTPUT=${PROJECT_BINARY_DIR}/generated/scanbench_version.hpp -P ${PROJECT_SOURCE_DIR}/cmake/write_version.cmake
  BYPRODUCTS ${PROJECT_BINARY_DIR}/generated/scanbench_version.hpp ${PROJECT_BINARY_DIR}/generated/scanbench_stamp.hpp
  VERBATIM)
