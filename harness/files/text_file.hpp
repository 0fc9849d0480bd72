// Input files as text: whole, bounded in size, unpacked when they are gzip.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace scanbench::harness {

/// The largest world, or set of lines, that is read.
inline constexpr std::size_t kMaxWorldBytes = std::size_t{64} << 20;

/// The bytes of a regular file, unpacked if they are gzip (told by the file's first bytes, not by its name). Throws
/// ConfigError for a missing, unreadable, damaged or cut-short file, for anything but a regular file, and for more than
/// max_bytes (after unpacking).
std::string read_text_file(const std::filesystem::path& path, std::uint64_t max_bytes);

/// "8 MiB", "1.5 GiB", "312 B".
std::string size_text(double bytes);

/// The next line of `rest`, without its line break (\n or \r\n), taken off its front.
std::string_view take_line(std::string_view& rest);

/// The words of a line, separated by blanks; the result is put into `words`, which keeps its memory.
void split_words(std::string_view line, std::vector<std::string_view>& words);

/// The fields of a row, separated by blanks or by a comma with any blanks around it: two commas enclose an empty field.
void split_fields(std::string_view line, std::vector<std::string_view>& fields);

/// 1-based column at which `word`, a part of `line`, begins.
int column_of(std::string_view line, std::string_view word);

/// Text from a file for a message: at most 40 characters, in quotes, control characters replaced by '?'.
std::string quoted_excerpt(std::string_view text);

}  // namespace scanbench::harness
