// The SHA-256 of files that this run has written, kept on disk until artefacts.sha256 lists them.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "harness/io/files/hash_list.hpp"

namespace scanbench::runs {

/// A run of 10^5 cells has a million files. Their hashes would be a hundred megabytes, which each fork copies the page
/// tables of, so they are in a temporary file. If that cannot be made or written, nothing is known, and the files are
/// read again.
class WrittenHashes {
 public:
  WrittenHashes();
  /// `lines` are of the files in `folder` (hash_lines()), which is relative to the run.
  void add(const std::filesystem::path& folder, const std::string& lines);
  /// By path, relative to the run. What was added last counts. Nothing may be added afterwards.
  io::FileHashes take();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace scanbench::runs
