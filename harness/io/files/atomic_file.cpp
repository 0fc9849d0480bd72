// Writes files and folders atomically with POSIX calls: std::filesystem has neither fsync nor an exchange of names.
#include "harness/io/files/atomic_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>

#include <fcntl.h>
#include <sys/random.h>
#include <unistd.h>

#include "core/error.hpp"
#include "harness/io/files/descriptor.hpp"
#include "harness/io/files/folder.hpp"
#include "harness/io/files/input_file.hpp"
#include "harness/io/files/system_error.hpp"

namespace scanbench::io {
namespace fs = std::filesystem;
namespace {

/// Throws ConfigError for a file that is missing or may not be read, and SystemError for every other failure.
[[noreturn]] void refuse(const std::string& verb, const fs::path& path, int error) {
  const std::string message = "cannot " + verb + " " + path.string() + ": " + std::strerror(error);
  const bool of_system = verb != "read" || error == EIO || error == EMFILE || error == ENFILE || error == ENOMEM;
  if (of_system) throw SystemError(message);
  throw ConfigError(message);
}

FileDescriptor opened(const fs::path& path, int flags) {
  return FileDescriptor(::open(path.c_str(), flags | O_CLOEXEC, 0666));
}

/// Returns 0, or errno.
int write_and_flush(const fs::path& path, std::string_view bytes, bool flush) {
  FileDescriptor file = opened(path, O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW);
  const bool written = file.is_open() && write_all(file.number(), std::as_bytes(std::span(bytes))) &&
                       (!flush || ::fsync(file.number()) == 0) && file.close() == 0;
  return written ? 0 : errno;
}

/// A larger file is not ours: a recording is held in memory as well.
std::uint64_t half_of_memory() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), page_bytes = ::sysconf(_SC_PAGESIZE);
  return pages > 0 && page_bytes > 0 ? static_cast<std::uint64_t>(pages) / 2 * static_cast<std::uint64_t>(page_bytes)
                                     : std::uint64_t{1} << 32;
}

constexpr std::string_view kAside = "-aside";

std::string temporary_prefix(const fs::path& path) {
  return "." + path.filename().string() + ".tmp-";
}

fs::path temporary_beside(const fs::path& path) {
  return path.parent_path() / (temporary_prefix(path) + std::to_string(::getpid()));
}

/// The folders beside `target` whose names temporary_beside() gives, of any process, and those that an exchange has put
/// aside; sorted.
std::vector<fs::path> unfinished_beside(const fs::path& target) {
  const std::string prefix = temporary_prefix(target);
  const fs::path parent = target.has_parent_path() ? target.parent_path() : fs::path(".");
  std::vector<fs::path> found;
  for (const std::string& name : names_in(parent)) {
    std::string_view process = name;
    if (!process.starts_with(prefix)) continue;
    process.remove_prefix(prefix.size());
    if (process.ends_with(kAside)) process.remove_suffix(kAside.size());
    std::error_code error;
    if (process.empty() || process.find_first_not_of("0123456789") != std::string_view::npos ||
        !fs::is_directory(fs::symlink_status(parent / name, error)))
      continue;
    found.push_back(parent / name);
  }
  return found;
}

}  // namespace

std::string read_file(const fs::path& path) {
  InputFile file(path);
  file.require_at_most(half_of_memory());
  std::string bytes;
  bytes.resize(file.size());
  std::size_t filled = 0;
  while (true) {
    // One more byte shows whether the file ends here. Files in /proc have size 0, so their buffer grows.
    if (filled == bytes.size()) bytes.resize(filled <= file.size() ? filled + 1 : 2 * filled);
    const std::size_t n = file.read(std::span(bytes).subspan(filled));
    if (n == 0) break;
    filled += n;
  }
  bytes.resize(filled);
  return bytes;
}

void write_file_atomically(const fs::path& path, std::string_view bytes) {
  const fs::path temporary = temporary_beside(path);
  int error = write_and_flush(temporary, bytes, true);
  if (error == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(temporary.c_str());
    refuse("write", path, error);
  }
  flush_folder(path.parent_path());
}

bool write_new_file(const fs::path& path, std::string_view bytes) {
  const fs::path temporary = temporary_beside(path);
  int error = write_and_flush(temporary, bytes, true);
  if (error == 0 && ::link(temporary.c_str(), path.c_str()) != 0) {
    error = errno;
    const bool has_links = error != EPERM && error != EOPNOTSUPP && error != ENOSYS;
    if (!has_links)
      error = ::renameat2(AT_FDCWD, temporary.c_str(), AT_FDCWD, path.c_str(), RENAME_NOREPLACE) == 0 ? 0 : errno;
  }
  ::unlink(temporary.c_str());
  if (error == EEXIST) return false;
  if (error != 0) refuse("write", path, error);
  flush_folder(path.parent_path());
  return true;
}

void write_staged_file(const fs::path& path, std::string_view bytes) {
  const int error = write_and_flush(path, bytes, false);
  if (error != 0) refuse("write", path, error);
}

void remove_file(const fs::path& path) {
  std::error_code error;
  fs::remove(path, error);
  if (error) refuse("remove", path, error.value());
}

void flush_folder(const fs::path& path) {
  const FileDescriptor folder = opened(path.empty() ? fs::path(".") : path, O_RDONLY | O_DIRECTORY);
  if (!folder.is_open() || ::fsync(folder.number()) != 0) refuse("write", path, errno);
}

void flush_file_system(const fs::path& path) {
  const FileDescriptor folder = opened(path, O_RDONLY | O_DIRECTORY);
  if (!folder.is_open() || ::syncfs(folder.number()) != 0) refuse("write", path, errno);
}

void make_folders(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) refuse("make the folder", path, error.value());
}

void exchange_folders(const fs::path& a, const fs::path& b) {
  if (::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0) return;
  if (errno != EINVAL && errno != ENOSYS) refuse("replace", b, errno);
  exchange_folders_in_steps(a, b);
}

void exchange_folders_in_steps(const fs::path& a, const fs::path& b) {
  // For an instant b does not exist, but a complete copy is beside it.
  const fs::path aside = temporary_beside(b).string() + std::string(kAside);
  if (::rename(b.c_str(), aside.c_str()) != 0) refuse("replace", b, errno);
  if (::rename(a.c_str(), b.c_str()) != 0) {
    const int error = errno;
    ::rename(aside.c_str(), b.c_str());
    refuse("replace", b, error);
  }
  if (::rename(aside.c_str(), a.c_str()) != 0) refuse("replace", b, errno);
}

std::vector<fs::path> folders_aside(const fs::path& folder) {
  std::vector<fs::path> aside;
  for (const fs::path& path : unfinished_beside(folder))
    if (path.filename().string().ends_with(kAside)) aside.push_back(path);
  return aside;
}

bool put_back(const fs::path& folder) {
  const auto aside = folders_aside(folder);
  if (aside.empty()) return false;
  if (::rename(aside.front().c_str(), folder.c_str()) != 0) {  // does not replace a folder that has files
    if (errno == ENOTEMPTY || errno == EEXIST) return false;
    refuse("put back", folder, errno);
  }
  flush_folder(folder.parent_path());
  return true;
}

void remove_temporaries(const fs::path& folder, const std::vector<fs::path>& kept) {
  std::vector<fs::path> found;
  for (auto it = fs::recursive_directory_iterator(folder); it != fs::recursive_directory_iterator(); ++it) {
    const bool is_kept = std::ranges::find(kept, it->path()) != kept.end();
    const bool is_found = !is_kept && is_temporary_name(it->path().filename().string());
    if (is_found) found.push_back(it->path());
    if ((is_kept || is_found) && it->is_directory() && !it->is_symlink()) it.disable_recursion_pending();
  }
  std::error_code ignored;
  for (const auto& path : found) fs::remove_all(path, ignored);
}

void remove_unfinished_folders(const fs::path& target) {
  put_back(target);
  std::error_code ignored;
  for (const fs::path& path : unfinished_beside(target)) fs::remove_all(path, ignored);
}

bool is_temporary_name(std::string_view name) {
  return name.starts_with('.') && name.find(".tmp-") != std::string_view::npos;
}

std::string unique_name() {
  std::uint64_t number = 0;
  if (::getrandom(&number, sizeof number, 0) != sizeof number) refuse("read", "random numbers of the system", errno);
  static constexpr std::string_view kDigits = "0123456789abcdef";
  std::string name;
  for (int shift = 60; shift >= 0; shift -= 4) name.push_back(kDigits[(number >> shift) & 15]);
  return name;
}

StagedFolder::StagedFolder(fs::path target) : StagedFolder(target, temporary_beside(target)) {}

StagedFolder::StagedFolder(fs::path target, fs::path staging)
    : target_(std::move(target)), staging_(std::move(staging)) {
  make_folders(target_.parent_path());
  clear();
}

StagedFolder StagedFolder::in_empty_folder(fs::path target, fs::path staging) {
  StagedFolder folder;
  folder.target_ = std::move(target);
  folder.staging_ = std::move(staging);
  return folder;
}

StagedFolder::StagedFolder(StagedFolder&& other) noexcept
    : target_(std::move(other.target_)), staging_(std::exchange(other.staging_, {})) {}

StagedFolder::~StagedFolder() {
  std::error_code ignored;
  if (!staging_.empty()) fs::remove_all(staging_, ignored);
}

void StagedFolder::clear() {
  std::error_code error;
  fs::remove_all(staging_, error);
  if (error) refuse("write", staging_, error.value());
  make_folders(staging_);
}

void StagedFolder::commit() {
  flush();
  place();
  flush_folder(target_.parent_path());
}

void StagedFolder::flush() const {
  // One call flushes all files of the folder: it takes 3 ms, while six calls of fsync take 20 ms.
  flush_file_system(staging_);
}

void StagedFolder::place() {
  std::error_code ignored;
  if (fs::exists(target_, ignored)) {
    exchange_folders(staging_, target_);
    fs::remove_all(staging_, ignored);
  } else if (::rename(staging_.c_str(), target_.c_str()) != 0) {
    refuse("write", target_, errno);
  }
  staging_.clear();
}

}  // namespace scanbench::io
