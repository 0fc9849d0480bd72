// Archives in the format of `tar`: POSIX's ustar, with GNU's entries for long paths.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace scanbench::io {

/// A file as an archive has it: a header of 512 bytes, its bytes, and zeros up to a multiple of 512. It has no owner
/// and no time, so equal paths and bytes give equal text. A path that the header has no room for gets an entry of its
/// own before it. Throws ConfigError for 8 GiB and more.
std::string tar_member(std::string_view path, std::string_view bytes);

/// The two blocks of zeros that end an archive.
std::string tar_end();

struct TarMember {
  std::string path;
  std::string_view bytes;  ///< in the text that was parsed
};

/// The members of an archive, or of a part of one that begins and ends between members. Throws ConfigError, which names
/// `file`, for text that tar_member() and tar_end() have not written.
std::vector<TarMember> tar_members(std::string_view archive, const std::filesystem::path& file);

}  // namespace scanbench::io
