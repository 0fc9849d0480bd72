// Replaces and locks run folders.
#include "harness/runs/store/run_target.hpp"

#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "harness/io/files/system_error.hpp"
#include "harness/runs/store/manifest.hpp"
#include "harness/runs/store/run_file.hpp"
#include "harness/runs/store/run_folder.hpp"
#include "harness/runs/store/run_store.hpp"

namespace scanbench::runs {
namespace fs = std::filesystem;
namespace {

/// True for an empty folder, and for the folder of a run that was killed before it wrote its manifest.
bool holds_only_temporaries(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (!io::is_temporary_name(entry.path().filename().string())) return false;
  return !error;
}

/// Gives a run its name back if its replacement was killed between two renames. The lock of a folder goes with it, so a
/// replacement that is still under way is found. Throws ConfigError for that.
void put_back_run(const fs::path& out) {
  std::error_code error;
  const auto aside = io::folders_aside(out);
  const bool exists = fs::exists(out, error);
  if (aside.empty() || (exists && !holds_only_temporaries(out))) return;
  const RunLock lock(aside.front());
  if (exists) {
    const RunLock empty(out);
    io::remove_temporaries(out);
  }
  io::put_back(out);
}

/// Keeps files that no run writes: makes hard links to them, or copies if the file system has no hard links. Throws
/// ConfigError with the file's name.
void carry_along(const fs::path& from, const fs::path& to) try {
  for (auto it = fs::recursive_directory_iterator(from); it != fs::recursive_directory_iterator(); ++it) {
    const fs::path relative = it->path().lexically_relative(from);
    if (io::is_temporary_name(relative.filename().string())) {
      if (it->is_directory()) it.disable_recursion_pending();
      continue;
    }
    if (it->is_directory() && !it->is_symlink()) {
      if (fs::is_empty(it->path()) && !holds_run_files(relative)) io::make_folders(to / relative);
      continue;
    }
    if (is_run_file(relative) || fs::exists(fs::symlink_status(to / relative))) continue;
    io::make_folders((to / relative).parent_path());
    std::error_code error;
    if (!it->is_symlink()) fs::create_hard_link(it->path(), to / relative, error);
    if (it->is_symlink() || error) fs::copy(it->path(), to / relative, fs::copy_options::copy_symlinks);
  }
} catch (const fs::filesystem_error& e) {
  throw io::SystemError(e.path1().string() + " does not belong to a run and cannot be kept in the new one: " +
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
  put_back_run(out_);
  if (fs::exists(out_, error) && !fs::is_directory(out_, error))
    throw ConfigError(out_.string() + " is a file; allowed: a folder");
  const bool empty = !fs::is_directory(out_, error) || holds_only_temporaries(out_);
  if (!empty && !fs::exists(out_ / kManifestFile))
    throw ConfigError(out_.string() +
                      " is not empty and has no manifest.json, so it is not the folder of a run; it stays unchanged");
  if (!empty) load_manifest(out_);  // refuses a manifest.json that is not ours
  for (fs::path folder = out_; folder.has_relative_path() && !fs::exists(folder, error); folder = folder.parent_path())
    first_made_ = folder;
  io::make_folders(out_);
  lock_.emplace(out_);
  io::remove_unfinished_folders(out_);
  resumed_ = resume && !empty;
  if (resumed_) {
    refuse_linked_folders(out_);
    RunStore(out_).require_folders();  // the files of its cells are what is resumed
  }
  if (resumed_ || empty) io::remove_temporaries(out_);
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

}  // namespace scanbench::runs
