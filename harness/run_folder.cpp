// Paths, replacement and locking of run folders.
#include "harness/run_folder.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "core/error.hpp"

namespace scanbench::harness {
namespace fs = std::filesystem;
namespace {

/// Temporary folders that a killed run left beside `out`: named after a process that no longer lives.
void remove_stale_siblings(const fs::path& out) {
  const std::string prefix = "." + out.filename().string() + ".tmp-";
  std::error_code ignored;
  std::vector<fs::path> stale;
  for (const auto& entry : fs::directory_iterator(out.parent_path(), ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix) || !entry.is_directory(ignored)) continue;
    int pid = 0;
    const auto [end, error] = std::from_chars(name.data() + prefix.size(), name.data() + name.size(), pid);
    if (error != std::errc{} || end != name.data() + name.size() || pid <= 0) continue;
    const bool ours = fs::exists(entry.path() / "manifest.json", ignored) || fs::is_empty(entry.path(), ignored);
    if (ours && ::kill(pid, 0) != 0 && errno == ESRCH) stale.push_back(entry.path());
  }
  for (const auto& path : stale) fs::remove_all(path, ignored);
}

/// Unfinished files and folders of a killed run inside its folder. We hold the lock: nobody is at work on them.
void remove_temporaries(const fs::path& run) {
  std::vector<fs::path> found;
  for (auto it = fs::recursive_directory_iterator(run); it != fs::recursive_directory_iterator(); ++it) {
    if (!is_temporary_name(it->path().filename().string())) continue;
    found.push_back(it->path());
    if (it->is_directory() && !it->is_symlink()) it.disable_recursion_pending();
  }
  std::error_code ignored;
  for (const auto& path : found) fs::remove_all(path, ignored);
}

/// What no run writes goes along, by a hard link where the file system has them.
void carry_along(const fs::path& from, const fs::path& to) {
  for (auto it = fs::recursive_directory_iterator(from); it != fs::recursive_directory_iterator(); ++it) {
    const fs::path relative = it->path().lexically_relative(from);
    if (is_temporary_name(relative.filename().string())) {
      if (it->is_directory()) it.disable_recursion_pending();
      continue;
    }
    if (it->is_directory() && !it->is_symlink()) {
      if (fs::is_empty(it->path()) && !is_run_file(relative / "x.png")) make_folders(to / relative);
      continue;
    }
    if (is_run_file(relative) || fs::exists(fs::symlink_status(to / relative))) continue;
    make_folders((to / relative).parent_path());
    std::error_code error;
    if (!it->is_symlink()) fs::create_hard_link(it->path(), to / relative, error);
    if (it->is_symlink() || error) fs::copy(it->path(), to / relative, fs::copy_options::copy_symlinks);
  }
}

}  // namespace

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
    return parts.size() == 4 && one_of({"walls.csv", "frames.csv", "lines.csv", "rotations.npy", "scan.json",
                                        "ranges.npy", "true_ranges.npy", "wall_ids.npy"});
  if (first == "cells")
    return parts.size() == 5 &&
           one_of({"status.json", "lines.csv", "labels.npy", "map.csv", "poses.csv", "pose_matches.csv",
                   "merge_labels.csv", "trace.csv", "timing.csv", "metrics.csv", "matches.csv", "pose_errors.csv"});
  return false;
}

RunTarget::RunTarget(fs::path out, bool resume) : out_(fs::absolute(out).lexically_normal()) {
  if (!out_.has_filename()) out_ = out_.parent_path();  // "run/" is "run"
  std::error_code error;
  if (fs::is_symlink(out_)) {
    const fs::path real = fs::canonical(out_, error);
    if (error) throw ConfigError(out_.string() + " is a symbolic link that leads nowhere; allowed: a folder");
    out_ = real;
  }
  if (fs::exists(out_, error) && !fs::is_directory(out_, error))
    throw ConfigError(out_.string() + " is a file; the folder of a run must be a folder of its own");
  const bool empty = !fs::is_directory(out_, error) || fs::is_empty(out_, error);
  if (!empty && !fs::exists(out_ / "manifest.json"))
    throw ConfigError(out_.string() +
                      " is not empty and has no manifest.json, so it is no run of ours and is left alone");
  if (!empty) load_manifest(out_);  // refuses somebody else's manifest.json
  for (fs::path folder = out_; folder.has_relative_path() && !fs::exists(folder, error); folder = folder.parent_path())
    first_made_ = folder;
  make_folders(out_);
  lock_ = ::open(out_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ < 0) throw ConfigError("cannot read " + out_.string() + ": " + std::strerror(errno));
  if (::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    ::close(lock_);
    throw ConfigError("another run is at work in " + out_.string());
  }
  remove_stale_siblings(out_);
  resumed_ = resume && !empty;
  if (resumed_) remove_temporaries(out_);
  if (!empty && !resume) staged_.emplace(out_);
}

RunTarget::~RunTarget() {
  ::close(lock_);
}

void RunTarget::finish() {
  if (!staged_) return;
  carry_along(out_, staged_->path());
  staged_->commit();
  staged_.reset();
}

void RunTarget::abandon() {
  std::error_code ignored;
  if (staged_) {
    staged_.reset();
  } else if (!resumed_) {
    // The folder was empty or absent: all that is in it is of this run.
    for (const auto& entry : fs::directory_iterator(out_, ignored)) fs::remove_all(entry.path(), ignored);
    if (first_made_.empty()) return;
    for (fs::path folder = out_; fs::remove(folder, ignored) && folder != first_made_;) folder = folder.parent_path();
  }
}

}  // namespace scanbench::harness
