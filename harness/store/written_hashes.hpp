// The SHA-256 of files that this run has written, kept on disk until manifest.json lists them.
#pragma once

#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

namespace scanbench::harness {

/// A line "name sha256" for every regular file of a folder.
std::string hash_lines(const std::filesystem::path& folder);
std::string hash_line(const std::string& name, const std::string& sha256);

/// A run of 10^5 cells has a million files. Their hashes would be a hundred megabytes, which each fork copies the page
/// tables of, so they are in a temporary file. If that cannot be made or written, nothing is known, and the files are
/// read again.
class WrittenHashes {
 public:
  WrittenHashes();
  /// `lines` are of the files in `folder`, relative to the run.
  void add(const std::filesystem::path& folder, const std::string& lines);
  /// By path, relative to the run. What was added last counts. Nothing may be added afterwards.
  std::map<std::string, std::string> take();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace scanbench::harness
