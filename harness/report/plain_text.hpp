// Makes text from modules, files and users safe for a terminal, a table or a Markdown page.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace scanbench::harness {

/// The text without control characters and invalid UTF-8: a terminal that shows it does nothing else. Line breaks stay.
/// Each escape character, bell and the like becomes "?", a tab a blank.
std::string plain_text(std::string_view text);

/// plain_text() on one line of at most `limit` bytes; a longer one is cut between characters and says how long it was.
std::string plain_line(std::string_view text, std::size_t limit = 600);

/// Text for Markdown: no HTML, no column of a table, no link or emphasis comes of it. One line.
std::string markdown_escaped(std::string_view text);

}  // namespace scanbench::harness
