// Names of the files of a run. Each writer declares its files, so that a new run knows which files of an old folder it
// replaces. It keeps all others, because they belong to the user.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>

namespace scanbench::runs {

/// One file, or one kind of file, of every run folder. Constants of this type exist before main() begins.
class RunFile {
 public:
  /// A path relative to the run folder; `*` is any number of characters of one name: "cells/*/*/*/lines.csv". It must
  /// be a literal, because it is kept as a view.
  explicit RunFile(std::string_view pattern);

  /// Its last part, "lines.csv".
  std::string name() const;

 private:
  std::string_view pattern_;
};

/// The file in its folder: cell_path(run, key) / kStatusFile.
std::filesystem::path operator/(const std::filesystem::path& folder, const RunFile& file);

/// The files that a metric family may leave in a cell, beside metrics.csv.
std::set<std::string> metric_table_files();

/// True for the paths, relative to the run folder, that a run, its figures and its reports write: those that match a
/// RunFile of this program, and the tables of the metric families.
bool is_run_file(const std::filesystem::path& relative);

/// True for the folders, relative to the run folder, that hold such files.
bool holds_run_files(const std::filesystem::path& relative);

}  // namespace scanbench::runs
