// Writes a table for a terminal and as Markdown. Best values are marked by characters, not by colour alone.
#include "harness/results/document/table.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "harness/results/document/plain_text.hpp"

namespace scanbench::results {
namespace {

std::string marked(const TableCell& cell) {
  return cell.best ? cell.text + "*" : cell.text;
}

std::string with_spread(const std::string& text, const TableCell& cell) {
  return cell.spread.empty() ? text : text + " " + cell.spread;
}

// Code points, not bytes: enough for the Latin and Greek letters and signs in our headings.
std::size_t display_width(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string padded(const std::string& text, std::size_t width, bool right) {
  const std::string space(width > display_width(text) ? width - display_width(text) : 0, ' ');
  return right ? space + text : text + space;
}

std::string flat_head(const TableColumn& column) {
  return column.group.empty() ? page_head(column) : page_group(column) + " " + page_head(column);
}

/// The first heading of a row, with its note.
std::string noted_head(const Table::Row& row) {
  return row.note.empty() ? row.heads.front() : row.heads.front() + " (" + row.note + ")";
}

// The table without characters that would control a terminal.
Table plain(Table table) {
  table.title = plain_line(table.title);
  for (auto& row : table.rows) {
    if (!row.heads.empty()) row.heads.front() = noted_head(row);
    for (auto& head : row.heads) head = plain_line(head);
    for (auto& cell : row.cells) cell.text = plain_line(cell.text);
  }
  return table;
}

/// Of a leading text column.
std::size_t head_width(const Table& table, std::size_t head) {
  std::size_t width = display_width(table.row_heads[head]);
  for (const auto& row : table.rows) width = std::max(width, display_width(row.heads[head]));
  return width;
}

std::size_t column_width(const Table& table, std::size_t column) {
  std::size_t width = display_width(table.columns[column].head);
  for (const auto& row : table.rows)
    width = std::max(width, display_width(with_spread(marked(row.cells[column]), row.cells[column])));
  return width;
}

// The columns [first, first + count) with the leading text columns.
Table part_of(const Table& table, std::size_t first, std::size_t count) {
  Table part = table;
  const auto from = static_cast<std::ptrdiff_t>(first);
  const auto to = static_cast<std::ptrdiff_t>(first + count);
  part.columns.assign(table.columns.begin() + from, table.columns.begin() + to);
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    part.rows[r].cells.assign(table.rows[r].cells.begin() + from, table.rows[r].cells.begin() + to);
  return part;
}

/// The caption for a table whose best values are bold: captions name the star of the terminal.
std::string bold_caption(std::string caption) {
  constexpr std::string_view kStar = "* marks the best";
  const auto at = caption.find(kStar);
  if (at == std::string::npos) return caption;
  const bool begins_sentence = at < 2 || caption[at - 2] == '.';
  return caption.replace(at, 1, begins_sentence ? "Bold" : "bold");
}

std::string without_trailing_blanks(const std::string& line) {
  return line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
}

/// A table that fits the width of the terminal.
class TerminalTable {
 public:
  TerminalTable(const Table& table, bool color) : table_(table), color_(color), heads_(table.row_heads.size()) {
    for (std::size_t h = 0; h < heads_; ++h) widths_.push_back(head_width(table, h));
    for (std::size_t c = 0; c < table.columns.size(); ++c) widths_.push_back(column_width(table, c));
    // A group wider than its columns widens the last of them.
    for (const auto& span : column_groups(table)) {
      const std::size_t group = display_width(span.group), columns = width_of(span);
      if (group > columns) widths_[heads_ + span.first + span.count - 1] += group - columns;
    }
  }

  std::string text() const {
    std::string out;
    if (!table_.title.empty()) out = (color_ ? "\x1b[1m" + table_.title + "\x1b[0m" : table_.title) + "\n";
    if (has_groups(table_)) out += group_line();
    out += head_line();
    for (const auto& row : table_.rows) out += row_line(row);
    return table_.caption.empty() ? out : out + table_.caption + "\n";
  }

 private:
  /// Of a group's columns, with the blanks between them.
  std::size_t width_of(const ColumnGroup& span) const {
    std::size_t width = 2 * (span.count - 1);
    for (std::size_t c = 0; c < span.count; ++c) width += widths_[heads_ + span.first + c];
    return width;
  }

  std::string group_line() const {
    std::string line;
    for (std::size_t h = 0; h < heads_; ++h) line += padded("", widths_[h], false) + "  ";
    for (const auto& span : column_groups(table_)) line += padded(span.group, width_of(span), false) + "   ";
    return without_trailing_blanks(line);
  }

  std::string head_line() const {
    std::string line;
    for (std::size_t h = 0; h < heads_; ++h) line += padded(table_.row_heads[h], widths_[h], false) + "  ";
    for (std::size_t c = 0; c < table_.columns.size(); ++c)
      line += value_text(table_.columns[c].head, c, table_.columns[c].published);
    return without_trailing_blanks(line);
  }

  std::string row_line(const Table::Row& row) const {
    std::string line;
    for (std::size_t h = 0; h < heads_; ++h)
      line += faint(padded(row.heads[h], widths_[h], false), row.published) + "  ";
    for (std::size_t c = 0; c < row.cells.size(); ++c)
      line += value_text(with_spread(marked(row.cells[c]), row.cells[c]), c,
                         row.cells[c].published || row.cells[c].not_eligible);
    return without_trailing_blanks(line);
  }

  /// Text of a column with the blanks behind it: one more between groups.
  std::string value_text(const std::string& text, std::size_t c, bool published) const {
    const bool boundary = c + 1 < table_.columns.size() && table_.columns[c].group != table_.columns[c + 1].group;
    return faint(padded(text, widths_[heads_ + c], true), published) + (boundary ? "   " : "  ");
  }

  std::string faint(const std::string& text, bool on) const {
    return on && color_ ? "\x1b[2m" + text + "\x1b[0m" : text;
  }

  const Table& table_;
  bool color_;
  std::size_t heads_;
  std::vector<std::size_t> widths_;  ///< of the heads, then of the columns
};

}  // namespace

std::vector<ColumnGroup> column_groups(const Table& table) {
  std::vector<ColumnGroup> groups;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    if (!groups.empty() && groups.back().group == table.columns[c].group)
      ++groups.back().count;
    else
      groups.push_back({table.columns[c].group, c, 1});
  }
  return groups;
}

bool has_groups(const Table& table) {
  return std::ranges::any_of(table.columns, [](const TableColumn& column) { return !column.group.empty(); });
}

std::string page_group(const TableColumn& column) {
  return column.words.empty() || column.group.empty() ? column.group : column.words;
}

std::string page_head(const TableColumn& column) {
  return column.words.empty() || !column.group.empty() ? column.head : column.words;
}

std::vector<Table> parts_of_width(const Table& table, std::size_t width) {
  std::size_t heads = 0;
  for (std::size_t h = 0; h < table.row_heads.size(); ++h) heads += head_width(table, h) + 2;
  std::vector<Table> parts;
  std::size_t first = 0;
  std::size_t used = heads;
  std::vector<ColumnGroup> spans;
  if (has_groups(table))
    spans = column_groups(table);
  else
    for (std::size_t c = 0; c < table.columns.size(); ++c) spans.push_back({"", c, 1});
  for (const auto& span : spans) {
    std::size_t wanted = 1;
    for (std::size_t c = span.first; c < span.first + span.count; ++c) wanted += column_width(table, c) + 2;
    if (span.first > first && used + wanted > width) {
      parts.push_back(part_of(table, first, span.first - first));
      first = span.first;
      used = heads;
    }
    used += wanted;
  }
  parts.push_back(part_of(table, first, table.columns.size() - first));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) parts[i].title.clear();
    if (i + 1 < parts.size()) parts[i].caption.clear();
  }
  return parts;
}

std::string to_terminal(const Table& table, bool color, std::size_t width) {
  std::string out;
  for (const auto& part : parts_of_width(plain(table), width))
    out += (out.empty() ? "" : "\n") + TerminalTable(part, color).text();
  return out;
}

std::string to_markdown(const Table& table) {
  std::string out = table.title.empty() ? "|" : "### " + table.title + "\n\n|";
  for (const auto& head : table.row_heads) out += " " + head + " |";
  for (const auto& column : table.columns) out += " " + flat_head(column) + " |";
  out += "\n|";
  for (std::size_t c = 0; c < table.row_heads.size(); ++c) out += "---|";
  for (std::size_t c = 0; c < table.columns.size(); ++c) out += "---:|";
  out += "\n";
  for (const auto& row : table.rows) {
    out += "|";
    for (std::size_t h = 0; h < row.heads.size(); ++h)
      out += " " + markdown_escaped(h == 0 ? noted_head(row) : row.heads[h]) + " |";
    for (const auto& cell : row.cells) {
      const std::string text = markdown_escaped(cell.text);
      out += " " + with_spread(cell.best ? "**" + text + "**" : text, cell) + " |";
    }
    out += "\n";
  }
  if (!table.caption.empty()) out += "\n" + bold_caption(table.caption) + "\n";
  return out;
}

}  // namespace scanbench::results
