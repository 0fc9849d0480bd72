// Paths, replacement and locking of run folders.
#include "harness/store/run_folder.hpp"

#include <algorithm>
#include <system_error>

#include <vector>

#include "core/error.hpp"

namespace scanbench::harness {
namespace fs = std::filesystem;
std::string to_string(const CellKey& key) {
  return key.scenario + "/" + key.pipeline + "/" + std::to_string(key.seed);
}

fs::path cell_path(const fs::path& run, const CellKey& key) {
  return run / "cells" / key.scenario / key.pipeline / std::to_string(key.seed);
}

fs::path recording_path(const fs::path& run, const std::string& scenario, std::uint64_t seed) {
  return run / "recordings" / scenario / std::to_string(seed);
}

void check_name(const std::string& what, const std::string& name) {
  if (name.empty() || name.front() == '.' || name.find('/') != std::string::npos ||
      name.find('\0') != std::string::npos || name.size() > 200)
    throw ConfigError("the name of a " + what + " is '" + name +
                      "'; it names a folder: allowed are 1 to 200 characters, no '/', no leading '.'");
}

void refuse_linked_folders(const fs::path& run) {
  const auto refuse_link = [](const fs::path& path) {
    if (fs::is_symlink(path) && fs::is_directory(path))
      throw ConfigError(path.string() + " is a symbolic link; the folders of a run must be folders of its own");
  };
  for (const char* name : {"cells", "effective", "figures", "published", "recordings", "scenarios"}) {
    refuse_link(run / name);
    std::error_code absent;
    for (const auto& entry : fs::recursive_directory_iterator(run / name, absent)) refuse_link(entry.path());
  }
}

bool is_run_file(const fs::path& relative) {
  std::vector<std::string> parts;
  for (const auto& part : relative) parts.push_back(part.string());
  if (parts.empty()) return false;
  const std::string& last = parts.back();
  const auto one_of = [&](std::initializer_list<std::string_view> names) {
    return std::ranges::count(names, last) > 0;
  };
  if (parts.size() == 1)
    return one_of({"manifest.json", "scenario.yaml", "effective.yaml", "summary.csv", "benchmark.json", "report.html",
                   "report.md"});
  const std::string& first = parts.front();
  const std::string ending = relative.extension().string();
  if (first == "figures") return ending == ".png" || ending == ".svg" || ending == ".pdf" || last == "index.json";
  if (first == "published") return parts.size() == 2 && one_of({"cells.csv", "orderings.csv", "agreement.csv"});
  if (first == "scenarios" || first == "effective") return parts.size() == 2 && ending == ".yaml";
  if (first == "recordings")
    return parts.size() == 4 &&
           one_of({"walls.csv", "frames.csv", "lines.csv", "rotations.npy", "scan.json", "ranges.npy",
                   "true_ranges.npy", "wall_ids.npy", "reference_poses.csv", "relations.csv"});
  if (first == "cells")
    return parts.size() == 5 &&
           one_of({"status.json", "lines.csv", "labels.npy", "map.csv", "poses.csv", "pose_matches.csv",
                   "merge_labels.csv", "trace.csv", "timing.csv", "metrics.csv", "matches.csv", "pose_errors.csv"});
  return false;
}

}  // namespace scanbench::harness
