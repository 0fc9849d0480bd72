// Makes text from modules, files and users safe for a terminal, a table, a page or a shell.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace scanbench::results {

/// The text without control characters and invalid UTF-8, so that it cannot control a terminal. Line breaks stay. Each
/// escape character, bell and the like becomes "?", a tab a blank.
std::string plain_text(std::string_view text);

/// plain_text() on one line of at most `limit` bytes; a longer line is cut between characters and states its length.
std::string plain_line(std::string_view text, std::size_t limit = 600);

/// Escapes text for Markdown, on one line, so that it makes no HTML, table column, link or emphasis.
std::string markdown_escaped(std::string_view text);

/// The five characters that HTML and XML reserve, escaped.
std::string html_escaped(std::string_view text);

/// ' name="value"' with the value escaped, or nothing without a value.
std::string html_attribute(const char* name, const std::string& value);

/// The text as one word of a POSIX shell: as it is, or in single quotes if it has other characters than letters, digits
/// and -_./=:,+@%.
std::string shell_word(std::string_view text);

}  // namespace scanbench::results
