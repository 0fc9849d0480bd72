// Paths of the files in a run folder.
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <string>

#include "harness/io/files/folder_name.hpp"

namespace scanbench::runs {

struct CellKey {
  std::string scenario;
  std::string pipeline;
  std::uint64_t seed = 0;
  auto operator<=>(const CellKey&) const = default;
};
std::string to_string(const CellKey& key);  ///< "scenario/pipeline/seed"

/// Throw ConfigError for names that are no FolderName.
std::filesystem::path cell_path(const std::filesystem::path& run, const CellKey& key);
std::filesystem::path recording_path(const std::filesystem::path& run, const std::string& scenario, std::uint64_t seed);

/// Throws ConfigError if a folder that a run writes into is a symbolic link: its files would be written elsewhere.
void refuse_linked_folders(const std::filesystem::path& run);

}  // namespace scanbench::runs
