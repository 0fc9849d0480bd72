// Writes a table for a terminal, as Markdown and as HTML. Best values are marked by characters, not by colour alone.
#include "harness/page/table.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "harness/page/plain_text.hpp"

namespace scanbench::harness {
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
  std::string text = html_escaped(marked(cell));
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

/// The caption, which speaks of the star that the terminal shows, for a table that has bold instead.
std::string bold_caption(std::string caption) {
  constexpr std::string_view kStar = "* marks the best";
  const auto at = caption.find(kStar);
  if (at == std::string::npos) return caption;
  const bool begins_sentence = at < 2 || caption[at - 2] == '.';
  return caption.replace(at, 1, begins_sentence ? "Bold" : "bold");
}

std::string part_to_terminal(const Table& table, bool color) {
  const std::size_t heads = table.row_heads.size();
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < heads + table.columns.size(); ++c) {
    std::size_t width = display_width(c < heads ? table.row_heads[c] : table.columns[c - heads].head);
    for (const auto& row : table.rows)
      width = std::max(
          width,
          display_width(c < heads ? row.heads[c] : with_spread(marked(row.cells[c - heads]), row.cells[c - heads])));
    widths.push_back(width);
  }
  const auto faint = [&](const std::string& text, bool on) {
    return on && color ? "\x1b[2m" + text + "\x1b[0m" : text;
  };

  std::string out;
  if (!table.title.empty()) out = (color ? "\x1b[1m" + table.title + "\x1b[0m" : table.title) + "\n";
  std::string line;
  if (has_groups(table)) {
    for (std::size_t c = 0; c < heads; ++c) line += padded("", widths[c], false) + "  ";
    for (const auto& span : group_spans(table)) {
      std::size_t width = 2 * (span.count - 1);
      for (std::size_t c = 0; c < span.count; ++c) width += widths[heads + span.first + c];
      // A group wider than its columns widens the last of them.
      if (display_width(span.group) > width) {
        widths[heads + span.first + span.count - 1] += display_width(span.group) - width;
        width = display_width(span.group);
      }
      line += padded(span.group, width, false) + "   ";
    }
    out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  const auto separator = [&](std::size_t c) {  // a wider gap between groups
    const bool boundary = c + 1 < table.columns.size() && table.columns[c].group != table.columns[c + 1].group;
    return boundary ? "   " : "  ";
  };
  line.clear();
  for (std::size_t c = 0; c < heads; ++c) line += padded(table.row_heads[c], widths[c], false) + "  ";
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    line += faint(padded(table.columns[c].head, widths[heads + c], true), table.columns[c].published) + separator(c);
  out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  for (const auto& row : table.rows) {
    line.clear();
    for (std::size_t c = 0; c < heads; ++c) line += faint(padded(row.heads[c], widths[c], false), row.published) + "  ";
    for (std::size_t c = 0; c < row.cells.size(); ++c)
      line += faint(padded(with_spread(marked(row.cells[c]), row.cells[c]), widths[heads + c], true),
                    row.cells[c].published) +
              separator(c);
    out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  if (!table.caption.empty()) out += table.caption + "\n";
  return out;
}

}  // namespace

std::vector<Table> parts_of_width(const Table& table, std::size_t width) {
  std::size_t heads = 0;
  for (std::size_t h = 0; h < table.row_heads.size(); ++h) {
    std::size_t widest = display_width(table.row_heads[h]);
    for (const auto& row : table.rows) widest = std::max(widest, display_width(row.heads[h]));
    heads += widest + 2;
  }
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
    out += (out.empty() ? "" : "\n") + part_to_terminal(part, color);
  return out;
}

std::string to_markdown(const Table& table) {
  std::string out = "### " + table.title + "\n\n|";
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
  // A part without a title continues the one before it.
  std::string out = table.title.empty() ? "<section class=\"table\">"
                                        : fmt::format(R"(<section class="table" id="{}"><h3>{}</h3>)",
                                                      html_escaped(table.id), html_escaped(table.title));
  out += "<div class=\"scroll\"><table>\n<thead>";
  if (has_groups(table)) {
    out += "<tr>";
    for (std::size_t c = 0; c < table.row_heads.size(); ++c) out += "<th></th>";
    for (const auto& span : group_spans(table))
      out += fmt::format(R"(<th class="group" colspan="{}">{}</th>)", span.count, html_escaped(span.group));
    out += "</tr>\n";
  }
  out += "<tr>";
  for (const auto& head : table.row_heads) out += "<th class=\"head\">" + html_escaped(head) + "</th>";
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const bool first = c == 0 || table.columns[c].group != table.columns[c - 1].group;
    out += fmt::format("<th class=\"{}{}\">{}</th>", table.columns[c].published ? "published " : "",
                       first ? "first" : "", html_escaped(table.columns[c].head));
  }
  out += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    out += row.published ? "<tr class=\"published\">" : "<tr>";
    for (const auto& head : row.heads) out += "<th class=\"head\">" + html_escaped(head) + "</th>";
    for (std::size_t c = 0; c < row.cells.size(); ++c) {
      const bool first = c == 0 || table.columns[c].group != table.columns[c - 1].group;
      const auto& cell = row.cells[c];
      out += fmt::format("<td class=\"{}{}{}{}\">{}</td>", cell.best ? "best " : "", cell.published ? "published " : "",
                         cell.state.empty() ? "" : cell.state + " ", first ? "first" : "", html_content(cell));
    }
    out += "</tr>\n";
  }
  out += "</tbody></table></div>";
  if (!table.caption.empty()) out += "<p class=\"caption\">" + html_escaped(table.caption) + "</p>";
  return out + "</section>\n";
}

std::string html_escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

}  // namespace scanbench::harness
