// The stamp of a shared library of modules: what must be equal in the library and in the program that loads it. It is
// text in the library's file, so that the program reads it before any code of the library runs.
#pragma once

#include <Eigen/Core>

#include "scanbench_stamp.hpp"  // made by the build: SCANBENCH_STAMP_VERSION, SCANBENCH_STAMP_HEADERS

#define SCANBENCH_STAMP_TEXT_OF(x) #x
#define SCANBENCH_STAMP_TEXT(x) SCANBENCH_STAMP_TEXT_OF(x)

#if defined(__clang__)
#define SCANBENCH_STAMP_COMPILER "clang " SCANBENCH_STAMP_TEXT(__clang_major__)
#else
#define SCANBENCH_STAMP_COMPILER "GNU " SCANBENCH_STAMP_TEXT(__GNUC__)
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(_GLIBCXX_DEBUG)
#define SCANBENCH_STAMP_CHECKS "checked"
#else
#define SCANBENCH_STAMP_CHECKS "plain"
#endif

#define SCANBENCH_STAMP_BEGIN "scanbench-plugin{"
#define SCANBENCH_STAMP_END "}"

/// "scanbench-plugin{version=0.1.0; headers=...; compiler=GNU 12; ...}". Classes of Eigen have other alignments under
/// -march=native, so the alignment is part of it.
#define SCANBENCH_PLUGIN_STAMP \
  SCANBENCH_STAMP_BEGIN "version=" SCANBENCH_STAMP_VERSION "; headers=" SCANBENCH_STAMP_HEADERS    \
                        "; compiler=" SCANBENCH_STAMP_COMPILER                                     \
                        "; abi=" SCANBENCH_STAMP_TEXT(__GXX_ABI_VERSION)                           \
                        "; strings=" SCANBENCH_STAMP_TEXT(_GLIBCXX_USE_CXX11_ABI)                  \
                        "; language=" SCANBENCH_STAMP_TEXT(__cplusplus)                            \
                        "; eigen=" SCANBENCH_STAMP_TEXT(EIGEN_WORLD_VERSION) "."                   \
                            SCANBENCH_STAMP_TEXT(EIGEN_MAJOR_VERSION) "."                          \
                            SCANBENCH_STAMP_TEXT(EIGEN_MINOR_VERSION)                              \
                        "; alignment=" SCANBENCH_STAMP_TEXT(EIGEN_MAX_STATIC_ALIGN_BYTES)          \
                        "; checks=" SCANBENCH_STAMP_CHECKS SCANBENCH_STAMP_END
