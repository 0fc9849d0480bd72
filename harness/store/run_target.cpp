// Replaces and locks run folders.
#include "harness/store/run_target.hpp"

#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "harness/files/system_error.hpp"
#include "harness/store/manifest.hpp"
#include "harness/store/run_file.hpp"
#include "harness/store/run_folder.hpp"
#include "harness/store/run_store.hpp"

namespace scanbench::harness {
namespace fs = std::filesystem;
namespace {

/// True for an empty folder, and for the folder of a run that was killed before it wrote its manifest.
bool holds_only_temporaries(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (!is_temporary_name(entry.path().filename().string())) return false;
  return !error;
}

/// Removes temporary folders that a killed run left beside `out`. The caller holds the lock of `out`, so no run uses
/// them.
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

/// Removes unfinished files and folders of a killed run inside its folder. The caller holds the lock, so no run uses
/// them.
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

/// Keeps files that no run writes: makes hard links to them, or copies if the file system has no hard links. Throws
/// ConfigError with the file's name.
void carry_along(const fs::path& from, const fs::path& to) try {
  for (auto it = fs::recursive_directory_iterator(from); it != fs::recursive_directory_iterator(); ++it) {
    const fs::path relative = it->path().lexically_relative(from);
    if (is_temporary_name(relative.filename().string())) {
      if (it->is_directory()) it.disable_recursion_pending();
      continue;
    }
    if (it->is_directory() && !it->is_symlink()) {
      if (fs::is_empty(it->path()) && !holds_run_files(relative)) make_folders(to / relative);
      continue;
    }
    if (is_run_file(relative) || fs::exists(fs::symlink_status(to / relative))) continue;
    make_folders((to / relative).parent_path());
    std::error_code error;
    if (!it->is_symlink()) fs::create_hard_link(it->path(), to / relative, error);
    if (it->is_symlink() || error) fs::copy(it->path(), to / relative, fs::copy_options::copy_symlinks);
  }
} catch (const fs::filesystem_error& e) {
  throw SystemError(e.path1().string() + " does not belong to a run and cannot be kept in the new one: " +
                    e.code().message() + "; remove it, or choose another folder");
}

}  // namespace

RunTarget::RunTarget(fs::path out, bool resume) : out_(fs::absolute(out).lexically_normal()) {
  if (!out_.has_filename()) out_ = out_.parent_path();  // "run/" is "run"
  std::error_code error;
  if (fs::is_symlink(out_)) {
    const fs::path real = fs::canonical(out_, error);
    if (error) throw ConfigError(out_.string() + " is a broken symbolic link; allowed: a folder");
    out_ = real;
  }
  if (fs::exists(out_, error) && !fs::is_directory(out_, error))
    throw ConfigError(out_.string() + " is a file; allowed: a folder");
  const bool empty = !fs::is_directory(out_, error) || holds_only_temporaries(out_);
  if (!empty && !fs::exists(out_ / kManifestFile))
    throw ConfigError(out_.string() +
                      " is not empty and has no manifest.json, so it is not the folder of a run; it stays unchanged");
  if (!empty) load_manifest(out_);  // refuses a manifest.json that is not ours
  for (fs::path folder = out_; folder.has_relative_path() && !fs::exists(folder, error); folder = folder.parent_path())
    first_made_ = folder;
  make_folders(out_);
  lock_.emplace(out_);
  remove_stale_siblings(out_);
  resumed_ = resume && !empty;
  if (resumed_) {
    refuse_linked_folders(out_);
    RunStore(out_).require_folders();  // the files of its cells are what is resumed
  }
  if (resumed_ || empty) remove_temporaries(out_);
  if (empty || resume) return;
  staged_.emplace(out_);
  carry_along(out_, staged_->path());  // now, so that a file that cannot be kept is reported before hours of work
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
    // The folder was empty or absent, so everything in it belongs to this run.
    for (const auto& entry : fs::directory_iterator(out_, ignored)) fs::remove_all(entry.path(), ignored);
    if (first_made_.empty()) return;
    for (fs::path folder = out_; fs::remove(folder, ignored) && folder != first_made_;) folder = folder.parent_path();
  }
}

}  // namespace scanbench::harness
