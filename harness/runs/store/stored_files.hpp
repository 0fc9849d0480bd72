// The files of one cell or recording, in its folder or read from an archive.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/io/files/csv.hpp"
#include "harness/runs/store/cell_archive.hpp"
#include "harness/runs/store/run_file.hpp"

namespace scanbench::runs {

class StoredFiles {
 public:
  /// The files of a folder, which are read when they are requested. The folder need not exist.
  StoredFiles(std::filesystem::path folder);  // NOLINT(*-explicit-*): a folder is one form of stored files
  /// Files of an archive. Messages name them as if they were in this folder.
  StoredFiles(std::filesystem::path folder, FolderFiles archived);

  bool exist() const;
  bool are_archived() const { return archived_.has_value(); }
  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path path(const std::string& name) const { return folder_ / name; }  ///< for messages
  std::filesystem::path path(const RunFile& file) const { return folder_ / file; }
  bool has(const std::string& name) const;
  bool has(const RunFile& file) const { return has(file.name()); }
  /// These throw ConfigError, which names the file.
  std::string read(const std::string& name) const;
  std::string read(const RunFile& file) const { return read(file.name()); }
  io::CsvTable table(const std::string& name, const std::vector<std::string>& required) const;
  io::CsvTable table(const RunFile& file, const std::vector<std::string>& required) const {
    return table(file.name(), required);
  }

 private:
  std::filesystem::path folder_;
  std::optional<FolderFiles> archived_;
};

}  // namespace scanbench::runs
