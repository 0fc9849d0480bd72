// Builds paths in a run folder, and checks its names and links.
#include "harness/runs/store/run_folder.hpp"

#include <algorithm>
#include <system_error>

#include <vector>

#include "core/error.hpp"

namespace scanbench::runs {
namespace fs = std::filesystem;
std::string to_string(const CellKey& key) {
  return key.scenario + "/" + key.pipeline + "/" + std::to_string(key.seed);
}

fs::path cell_path(const fs::path& run, const CellKey& key) {
  return run / "cells" / io::check_name("scenario", key.scenario) / io::check_name("pipeline", key.pipeline) /
         std::to_string(key.seed);
}

fs::path recording_path(const fs::path& run, const std::string& scenario, std::uint64_t seed) {
  return run / "recordings" / io::check_name("scenario", scenario) / std::to_string(seed);
}

void refuse_linked_folders(const fs::path& run) {
  const auto refuse_link = [](const fs::path& path) {
    if (fs::is_symlink(path) && fs::is_directory(path))
      throw ConfigError(path.string() + " is a symbolic link; the folders of a run must be folders of its own");
  };
  for (const char* name : {"cells", "effective", "figures", "inputs", "published", "recordings", "scenarios"}) {
    refuse_link(run / name);
    std::error_code absent;
    for (const auto& entry : fs::recursive_directory_iterator(run / name, absent)) refuse_link(entry.path());
  }
}

}  // namespace scanbench::runs
