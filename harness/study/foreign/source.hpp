// Modules that are not part of this program: what they say of themselves, and where they come from.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/params.hpp"
#include "core/registry.hpp"

namespace scanbench::study {

/// What a foreign module says of itself.
struct ForeignModule {
  std::string kind;  ///< extract, match, align, map, merge
  ModuleInfo info;
  std::string version;  ///< of the module, in the author's words
  std::vector<ParamSpec> params;
};

/// A file whose bytes decide what a module computes.
struct HashedFile {
  std::filesystem::path path;
  std::string sha256;
};

/// A program or a shared library that holds one module.
struct ForeignSource {
  std::vector<std::string> program;     ///< its arguments, the program itself first; empty: a library
  std::filesystem::path library;        ///< empty: a program
  std::vector<HashedFile> files;        ///< the library; of a program the arguments that are files, and further ones
  std::vector<std::string> more_files;  ///< of `files` those that are not arguments
  double scan_seconds = 10.0;           ///< of a program: wall time of a call about one scan
  ForeignModule module;

  // Defined once, in source.cpp: inline they cost seconds in every unit that has one.
  ForeignSource();
  ForeignSource(const ForeignSource&);
  ForeignSource(ForeignSource&&) noexcept;
  ForeignSource& operator=(const ForeignSource&);
  ForeignSource& operator=(ForeignSource&&) noexcept;
  ~ForeignSource();

  /// As in messages: "python3 my_lines.py", "libmy_lines.so". Paths of files are without folders.
  std::string text() const;
};

/// What a run allows to programs, besides the limits of the cell.
struct ForeignSetting {
  bool sandbox = false;                   ///< run programs under bubblewrap
  std::filesystem::path writable_folder;  ///< the only one that a program in the sandbox can write to; may be empty
  std::filesystem::path hidden_folder;    ///< shown empty in the sandbox, but for the writable one; may be empty
};

}  // namespace scanbench::study
