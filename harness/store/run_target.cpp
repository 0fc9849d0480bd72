// Replacement and locking of run folders.
#include "harness/store/run_target.hpp"

#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "harness/files/system_error.hpp"
#include "harness/store/manifest.hpp"
#include "harness/store/run_file.hpp"
#include "harness/store/run_folder.hpp"

namespace scanbench::harness {
namespace fs = std::filesystem;
namespace {

/// True for an empty folder, and for one that a run left that was killed before its manifest was there.
bool holds_only_temporaries(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (!is_temporary_name(entry.path().filename().string())) return false;
  return !error;
}

/// Temporary folders that a killed run left beside `out`. We hold the lock of `out`: nobody is at work in them.
void remove_stale_siblings(const fs::path& out) {
  const std::string prefix = "." + out.filename().string() + ".tmp-";
  std::error_code ignored;
  std::vector<fs::path> stale;
  for (const auto& entry : fs::directory_iterator(out.parent_path(), ignored)) {
    const fs::path& path = entry.path();
    if (!path.filename().string().starts_with(prefix) || !fs::is_directory(entry.symlink_status(ignored))) continue;
    if (fs::exists(path / kManifestFile, ignored) || holds_only_temporaries(path)) stale.push_back(path);
  }
  for (const auto& path : stale) fs::remove_all(path, ignored);
}

/// Removes unfinished files and folders of a killed run inside its folder. We hold the lock: nobody is at work on them.
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

/// Takes over what no run writes, by a hard link where the file system has them. Throws ConfigError, naming the file.
void carry_along(const fs::path& from, const fs::path& to) try {
  for (auto it = fs::recursive_directory_iterator(from); it != fs::recursive_directory_iterator(); ++it) {
    const fs::path relative = it->path().lexically_relative(from);
    if (is_temporary_name(relative.filename().string())) {
      if (it->is_directory()) it.disable_recursion_pending();
      continue;
    }
    if (it->is_directory() && !it->is_symlink()) {
      if (fs::is_empty(it->path()) && !is_run_folder(relative)) make_folders(to / relative);
      continue;
    }
    if (is_run_file(relative) || fs::exists(fs::symlink_status(to / relative))) continue;
    make_folders((to / relative).parent_path());
    std::error_code error;
    if (!it->is_symlink()) fs::create_hard_link(it->path(), to / relative, error);
    if (it->is_symlink() || error) fs::copy(it->path(), to / relative, fs::copy_options::copy_symlinks);
  }
} catch (const fs::filesystem_error& e) {
  throw SystemError(e.path1().string() + " is no file of a run and cannot be taken over into the new one: " +
                    e.code().message() + "; remove it, or give another folder");
}

}  // namespace

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
  const bool empty = !fs::is_directory(out_, error) || holds_only_temporaries(out_);
  if (!empty && !fs::exists(out_ / kManifestFile))
    throw ConfigError(out_.string() +
                      " is not empty and has no manifest.json, so it is no run of ours and is left alone");
  if (!empty) load_manifest(out_);  // refuses a manifest.json that is not ours
  for (fs::path folder = out_; folder.has_relative_path() && !fs::exists(folder, error); folder = folder.parent_path())
    first_made_ = folder;
  make_folders(out_);
  lock_.emplace(out_);
  remove_stale_siblings(out_);
  resumed_ = resume && !empty;
  if (resumed_) refuse_linked_folders(out_);
  if (resumed_ || empty) remove_temporaries(out_);
  if (empty || resume) return;
  staged_.emplace(out_);
  carry_along(out_, staged_->path());  // here, so that what cannot be taken over is known before hours of work
  staged_->clear();
  staged_lock_.emplace(staged_->path());
}

void RunTarget::finish() {
  if (!staged_) return;
  carry_along(out_, staged_->path());
  staged_->commit();
  staged_.reset();
  lock_ = std::move(staged_lock_);
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
