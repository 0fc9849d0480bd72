// Writes tables as HTML. Best values are marked by a character, not by their weight alone.
#include "harness/results/document/html_table.hpp"

#include <cstddef>
#include <string_view>

#include <fmt/format.h>

#include "harness/results/document/plain_text.hpp"

namespace scanbench::results {
namespace {

/// `words` behind a blank, if there are any before it.
void add_word(std::string& words, const std::string& word) {
  if (!word.empty()) words += (words.empty() ? "" : " ") + word;
}

/// Where the interval or range of a value begins: "0.80 ± 0.03", "0.97 (0.88 to 0.99)"; npos if there is none. It is
/// below the value, because columns are then half as wide. A unit behind it keeps both on one line.
std::size_t interval_at(const std::string& text) {
  constexpr std::string_view kPlusMinus = " ± ";
  std::size_t at = text.find(kPlusMinus);
  if (at != std::string::npos && text.find(' ', at + kPlusMinus.size()) != std::string::npos) return std::string::npos;
  if (at == std::string::npos && text.ends_with(')') && text.find(" to ") != std::string::npos) at = text.find(" (");
  return at == std::string::npos || text.find(' ') < at ? std::string::npos : at;
}

std::string html_content(const TableCell& cell) {
  const std::size_t interval = interval_at(cell.text);
  const std::string value = cell.text.substr(0, interval);
  std::string text = html_escaped(cell.best ? value + "*" : value) + cell.drawing;
  const std::string hint = html_attribute("title", cell.hint);
  if (!cell.link.empty())
    text = fmt::format("<a href=\"{}\"{}>{}</a>", html_escaped(cell.link), hint, text);
  else if (!hint.empty())
    text = fmt::format("<span{}>{}</span>", hint, text);
  std::string below = interval == std::string::npos ? "" : cell.text.substr(interval + 1);
  add_word(below, cell.spread);
  return below.empty() ? text : text + "<small>" + html_escaped(below) + "</small>";
}

/// A head whose arrow stays on the line of the word before it.
std::string html_head(const std::string& head) {
  std::string text = html_escaped(head);
  for (const std::string_view sign : {"↑", "↓", "≈ "}) {
    const std::size_t at = text.find(" " + std::string(sign));
    if (at == std::string::npos) continue;
    if (sign.ends_with(' ')) text.replace(at + sign.size(), 1, "&nbsp;");
    text.replace(at, 1, "&nbsp;");
  }
  return text;
}

bool begins_group(const Table& table, std::size_t column) {
  return column == 0 || table.columns[column].group != table.columns[column - 1].group;
}

/// The rows of thead. The last one has a head for every column.
std::string html_heads(const Table& table) {
  const bool grouped = has_groups(table);
  std::string out;
  if (grouped) {
    out += "<tr>";
    for (std::size_t c = 0; c < table.row_heads.size(); ++c) out += "<td class=\"head\"></td>";
    for (const ColumnGroup& group : column_groups(table)) {
      const TableColumn& first = table.columns[group.first];
      out += fmt::format(R"(<th class="group" scope="colgroup" colspan="{}"{}>{}</th>)", group.count,
                         html_attribute("title", first.metric), html_head(page_group(first)));
    }
    out += "</tr>\n";
  }
  out += "<tr>";
  for (const auto& head : table.row_heads) out += "<th class=\"head\" scope=\"col\">" + html_escaped(head) + "</th>";
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const TableColumn& column = table.columns[c];
    std::string classes = column.published ? "published" : "";
    if (begins_group(table, c)) add_word(classes, "first");
    out += fmt::format("<th scope=\"col\"{}{}>{}</th>", html_attribute("class", classes),
                       html_attribute("title", column.metric), html_head(page_head(column)));
  }
  return out + "</tr>";
}

std::string row_head(const Table::Row& row, std::size_t h) {
  std::string text = html_escaped(row.heads[h]);
  if (h == 0 && !row.link.empty()) text = fmt::format("<a href=\"{}\">{}</a>", html_escaped(row.link), text);
  if (h == 0 && !row.note.empty()) text += "<small>" + html_escaped(row.note) + "</small>";
  return "<th class=\"head\" scope=\"row\">" + text + "</th>";
}

std::string html_row(const Table& table, const Table::Row& row) {
  std::string out = row.published ? "<tr class=\"published\">" : "<tr>";
  for (std::size_t h = 0; h < row.heads.size(); ++h) out += row_head(row, h);
  for (std::size_t c = 0; c < row.cells.size(); ++c) {
    const TableCell& cell = row.cells[c];
    std::string classes = cell.best ? "best" : "";
    if (cell.published) add_word(classes, "published");
    if (cell.not_eligible) add_word(classes, "not-eligible");
    add_word(classes, cell.state);
    if (begins_group(table, c)) add_word(classes, "first");
    out += "<td" + html_attribute("class", classes) + ">" + html_content(cell) + "</td>";
  }
  return out + "</tr>\n";
}

/// The cells of a table of one column beside each other, each with the head of its row.
std::string chips_to_html(const Table& table) {
  std::string out = "<section class=\"chips\"><h3>" + html_escaped(table.title) + "</h3><div>\n";
  for (const auto& row : table.rows) {
    const TableCell& cell = row.cells.front();
    const std::string tag = cell.link.empty() ? "span" : "a";
    out += fmt::format("<{0} class=\"chip {1}\"{2}><b>{3}</b>{4}<small>{5}</small></{0}>\n", tag, cell.state,
                       html_attribute("href", cell.link), html_escaped(row.heads.front()), html_escaped(cell.text),
                       html_escaped(cell.spread));
  }
  return out + "</div></section>\n";
}

}  // namespace

std::string to_html(const Table& table) {
  if (table.side_by_side) return chips_to_html(table);
  const bool titled = !table.title.empty();
  std::string out = fmt::format("<section class=\"table\"{}>", titled ? html_attribute("id", table.id) : "");
  // The box takes the keyboard, so that its columns can be reached without a pointer.
  out += fmt::format("<div class=\"scroll\" tabindex=\"0\"{}><table>\n",
                     titled ? " role=\"region\"" + html_attribute("aria-label", table.title) : "");
  if (titled) out += "<caption><h3>" + html_escaped(table.title) + "</h3></caption>\n";
  out += "<thead>" + html_heads(table) + "</thead>\n<tbody>\n";
  for (const auto& row : table.rows) out += html_row(table, row);
  out += "</tbody></table></div>";
  if (!table.caption.empty()) out += "<p class=\"caption\">" + html_escaped(table.caption) + "</p>";
  return out + "</section>\n";
}

}  // namespace scanbench::results
