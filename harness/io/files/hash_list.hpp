// Lists of SHA-256 in the format of coreutils: "hash  path", a file per line, as `sha256sum -c` reads them.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace scanbench::io {

/// SHA-256 in hexadecimal digits, by path.
using FileHashes = std::map<std::string, std::string>;

/// One line. If the path has a backslash or a line end, the line begins with a backslash and these are escaped.
std::string hash_line(const std::string& path, const std::string& sha256);

/// A line for every regular file of a folder, with its name as path.
std::string hash_lines(const std::filesystem::path& folder);

/// A line for every file, sorted by the bytes of the paths.
std::string hash_list(const FileHashes& hashes);

/// Reads such lines, in any order; of several lines with one path, the last counts. `file` is for messages. Throws
/// ConfigError with file:line.
FileHashes parse_hash_list(std::string_view text, const std::string& file);

}  // namespace scanbench::io
