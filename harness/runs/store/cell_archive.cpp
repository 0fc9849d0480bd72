// Appends folders to a tar file and reads single ones back.
#include "harness/runs/store/cell_archive.hpp"

#include <cerrno>
#include <cstring>
#include <ranges>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "core/error.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/folder.hpp"
#include "harness/io/files/folder_name.hpp"
#include "harness/io/files/hash.hpp"
#include "harness/io/files/size_text.hpp"
#include "harness/io/files/system_error.hpp"
#include "harness/io/files/tar.hpp"

namespace scanbench::runs {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void refuse(const fs::path& file, int error) {
  throw io::SystemError("cannot write " + file.string() + ": " + std::strerror(error));
}

template <class Names>
FolderFiles read_named(const fs::path& folder, const Names& names, std::uint64_t most) {
  std::uint64_t bytes = 0;
  for (const std::string& name : names) bytes += io::InputFile(folder / name).size();
  if (bytes > most)
    throw ConfigError("the files of " + folder.generic_string() + " have " + io::size_text(static_cast<double>(bytes)) +
                      "; allowed in an archive: " + io::size_text(static_cast<double>(most)));
  FolderFiles files;
  for (const std::string& name : names) files.emplace(name, io::read_file(folder / name));
  return files;
}

}  // namespace

FolderFiles read_files(const fs::path& folder, const io::FileHashes& listed, std::uint64_t most) {
  FolderFiles files = read_named(folder, std::views::keys(listed), most);
  for (const auto& [name, bytes] : files)
    if (io::sha256_hex(bytes) != listed.at(name))
      throw ConfigError((folder / name).generic_string() + " has changed since it was written");
  return files;
}

FolderFiles read_folder(const fs::path& folder, std::uint64_t most) {
  return read_named(folder, io::names_in(folder), most);
}

ArchiveWriter::ArchiveWriter(fs::path file)
    : file_(std::move(file)),
      descriptor_(::open(file_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) refuse(file_, errno);
}

ArchiveWriter::~ArchiveWriter() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

ArchivePart ArchiveWriter::add(const fs::path& folder, const FolderFiles& files) {
  std::string text;
  for (const auto& [name, bytes] : files) text += io::tar_member((folder / name).generic_string(), bytes);
  ArchivePart part{end_, text.size(), io::sha256_hex(text)};
  append(text);
  return part;
}

std::string ArchiveWriter::finish() {
  append(io::tar_end());
  if (::close(std::exchange(descriptor_, -1)) != 0) refuse(file_, errno);
  return hash_.hex();
}

void ArchiveWriter::append(std::span<const char> bytes) {
  for (std::size_t written = 0; written < bytes.size();) {
    const ssize_t n =
        ::pwrite(descriptor_, bytes.data() + written, bytes.size() - written, static_cast<off_t>(end_ + written));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      const int error = errno;
      if (::ftruncate(descriptor_, static_cast<off_t>(end_)) != 0) refuse(file_, errno);
      refuse(file_, error);
    }
    written += static_cast<std::size_t>(n);
  }
  hash_.add({bytes.data(), bytes.size()});
  end_ += bytes.size();
}

bool ArchiveReader::is_whole(const ArchivePart& part) const {
  if (part.offset > file_.size() || part.bytes > file_.size() - part.offset) return false;
  return io::sha256_hex(read(part)) == part.sha256;
}

FolderFiles ArchiveReader::files(const ArchivePart& part, const fs::path& folder) const {
  const bool fits = part.offset <= file_.size() && part.bytes <= file_.size() - part.offset;
  const std::string bytes = fits ? read(part) : "";
  if (!fits || io::sha256_hex(bytes) != part.sha256)
    throw ConfigError(file_.path().string() + " is cut off or has been changed: " + folder.generic_string() +
                      " is damaged");
  const std::string prefix = folder.generic_string() + "/";
  FolderFiles files;
  for (const auto& member : io::tar_members(bytes, file_.path())) {
    const std::string name = member.path.starts_with(prefix) ? member.path.substr(prefix.size()) : "";
    if (!io::is_folder_name(name))
      throw ConfigError(file_.path().string() + ": a file of " + folder.generic_string() + " is called " + member.path);
    files.emplace(name, member.bytes);
  }
  return files;
}

std::string ArchiveReader::read(const ArchivePart& part) const {
  std::string bytes(part.bytes, '\0');
  bytes.resize(file_.read_at(part.offset, bytes));
  return bytes;
}

}  // namespace scanbench::runs
