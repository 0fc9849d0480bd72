// Writes a table for a terminal, as Markdown and as HTML. Best values are marked by characters, not by colour alone.
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

// The table without characters that would control a terminal.
Table plain(Table table) {
  table.title = plain_line(table.title);
  for (auto& row : table.rows) {
    for (auto& head : row.heads) head = plain_line(head);
    for (auto& cell : row.cells) cell.text = plain_line(cell.text);
  }
  return table;
}

std::string html_content(const TableCell& cell) {
  std::string text = html_escaped(marked(cell)) + cell.drawing;
  const std::string hint = cell.hint.empty() ? "" : " title=\"" + html_escaped(cell.hint) + "\"";
  if (!cell.link.empty())
    text = fmt::format("<a href=\"{}\"{}>{}</a>", html_escaped(cell.link), hint, text);
  else if (!hint.empty())
    text = fmt::format("<span{}>{}</span>", hint, text);
  return cell.spread.empty() ? text : text + "<small>" + html_escaped(cell.spread) + "</small>";
}

bool has_groups(const Table& table) {
  return std::ranges::any_of(table.columns, [](const TableColumn& c) { return !c.group.empty(); });
}

// Neighbouring columns of one group: first column and number of columns.
struct Span {
  std::string group;
  std::size_t first;
  std::size_t count;
};

std::vector<Span> group_spans(const Table& table) {
  std::vector<Span> spans;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    if (!spans.empty() && spans.back().group == table.columns[c].group)
      ++spans.back().count;
    else
      spans.push_back({table.columns[c].group, c, 1});
  }
  return spans;
}

std::string flat_head(const TableColumn& column) {
  return column.group.empty() ? column.head : column.group + " " + column.head;
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
    for (const auto& span : group_spans(table)) {
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
  std::size_t width_of(const Span& span) const {
    std::size_t width = 2 * (span.count - 1);
    for (std::size_t c = 0; c < span.count; ++c) width += widths_[heads_ + span.first + c];
    return width;
  }

  std::string group_line() const {
    std::string line;
    for (std::size_t h = 0; h < heads_; ++h) line += padded("", widths_[h], false) + "  ";
    for (const auto& span : group_spans(table_)) line += padded(span.group, width_of(span), false) + "   ";
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

bool begins_group(const Table& table, std::size_t column) {
  return column == 0 || table.columns[column].group != table.columns[column - 1].group;
}

/// The rows of thead.
std::string html_heads(const Table& table) {
  std::string out;
  if (has_groups(table)) {
    out += "<tr>";
    for (std::size_t c = 0; c < table.row_heads.size(); ++c) out += "<th></th>";
    for (const auto& span : group_spans(table))
      out += fmt::format(R"(<th class="group" colspan="{}">{}</th>)", span.count, html_escaped(span.group));
    out += "</tr>\n";
  }
  out += "<tr>";
  for (const auto& head : table.row_heads) out += "<th class=\"head\">" + html_escaped(head) + "</th>";
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    out += fmt::format("<th class=\"{}{}\">{}</th>", table.columns[c].published ? "published " : "",
                       begins_group(table, c) ? "first" : "", html_escaped(table.columns[c].head));
  return out + "</tr>";
}

std::string html_row(const Table& table, const Table::Row& row) {
  std::string out = row.published ? "<tr class=\"published\">" : "<tr>";
  for (const auto& head : row.heads) out += "<th class=\"head\">" + html_escaped(head) + "</th>";
  for (std::size_t c = 0; c < row.cells.size(); ++c) {
    const auto& cell = row.cells[c];
    out += fmt::format("<td class=\"{}{}{}{}{}\">{}</td>", cell.best ? "best " : "", cell.published ? "published " : "",
                       cell.not_eligible ? "not-eligible " : "", cell.state.empty() ? "" : cell.state + " ",
                       begins_group(table, c) ? "first" : "", html_content(cell));
  }
  return out + "</tr>\n";
}

std::string part_to_html(const Table& table) {
  // A part without a title continues the one before it.
  std::string out = table.title.empty() ? "<section class=\"table\">"
                                        : fmt::format(R"(<section class="table" id="{}"><h3>{}</h3>)",
                                                      html_escaped(table.id), html_escaped(table.title));
  out += "<div class=\"scroll\"><table>\n<thead>" + html_heads(table) + "</thead>\n<tbody>\n";
  for (const auto& row : table.rows) out += html_row(table, row);
  out += "</tbody></table></div>";
  if (!table.caption.empty()) out += "<p class=\"caption\">" + html_escaped(table.caption) + "</p>";
  return out + "</section>\n";
}

/// The cells of a table of one column beside each other, each with the head of its row.
std::string chips_to_html(const Table& table) {
  std::string out = "<section class=\"chips\"><h3>" + html_escaped(table.title) + "</h3><div>\n";
  for (const auto& row : table.rows) {
    const TableCell& cell = row.cells.front();
    const std::string tag = cell.link.empty() ? "span" : "a";
    const std::string link = cell.link.empty() ? "" : " href=\"" + html_escaped(cell.link) + "\"";
    out += fmt::format("<{0} class=\"chip {1}\"{2}><b>{3}</b>{4}<small>{5}</small></{0}>\n", tag, cell.state, link,
                       html_escaped(row.heads.front()), html_escaped(cell.text), html_escaped(cell.spread));
  }
  return out + "</div></section>\n";
}

}  // namespace

std::vector<Table> parts_of_width(const Table& table, std::size_t width) {
  std::size_t heads = 0;
  for (std::size_t h = 0; h < table.row_heads.size(); ++h) heads += head_width(table, h) + 2;
  std::vector<Table> parts;
  std::size_t first = 0;
  std::size_t used = heads;
  std::vector<Span> spans;
  if (has_groups(table))
    spans = group_spans(table);
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
    for (const auto& head : row.heads) out += " " + markdown_escaped(head) + " |";
    for (const auto& cell : row.cells) {
      const std::string text = markdown_escaped(cell.text);
      out += " " + with_spread(cell.best ? "**" + text + "**" : text, cell) + " |";
    }
    out += "\n";
  }
  if (!table.caption.empty()) out += "\n" + bold_caption(table.caption) + "\n";
  return out;
}

std::string to_html(const Table& table) {
  if (table.side_by_side) return chips_to_html(table);
  std::string out;
  for (const auto& part : parts_of_width(table, table.page_width)) out += part_to_html(part);
  return out;
}

}  // namespace scanbench::results
