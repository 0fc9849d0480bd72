// Reads input files as text: bounded in size, unpacked if they are gzip.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/io/files/size_text.hpp"

namespace scanbench::io {

/// Size limit of a world file or a line set.
inline constexpr std::size_t kMaxWorldBytes = std::size_t{64} << 20;

/// Calls `use` with the bytes of a regular file, block by block, unpacked if they are gzip (recognized by the file's
/// first bytes, not by its name). Throws ConfigError for a missing, unreadable, damaged or truncated file, for a path
/// that is not a regular file, for more than max_bytes (packed or unpacked), and for a zero byte. Messages begin with
/// the file's name; that of the zero byte ends with `allowed`, the kind of file that is expected.
void for_each_text_block(const std::filesystem::path& path, std::uint64_t max_bytes, std::string_view allowed,
                         const std::function<void(std::string_view)>& use);

/// Returns all bytes of such a file.
std::string read_text_file(const std::filesystem::path& path, std::uint64_t max_bytes,
                           std::string_view allowed = "a text file in UTF-8");

/// Removes the first line from `rest` and returns it without its line break (\n or \r\n).
std::string_view take_line(std::string_view& rest);

/// Splits a line at blanks. Overwrites `words`, whose memory is reused from call to call.
void split_words(std::string_view line, std::vector<std::string_view>& words);

/// Splits a row at blanks, or at commas with any blanks around them. Two commas enclose an empty field.
void split_fields(std::string_view line, std::vector<std::string_view>& fields);

/// 1-based column at which `word`, a part of `line`, begins.
int column_of(std::string_view line, std::string_view word);

/// Text from a file for a message: at most 40 characters, in quotes, control characters replaced by '?'.
std::string quoted_excerpt(std::string_view text);

}  // namespace scanbench::io
