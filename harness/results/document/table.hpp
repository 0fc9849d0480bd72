// Tables that are written as terminal text, Markdown and HTML.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace scanbench::results {

struct TableCell {
  std::string text;
  bool best = false;       ///< the best of its row or column
  bool published = false;  ///< from a paper, not computed here
  std::string spread{};    ///< "± 0.12": after the text, below it in HTML; may be empty
  std::string link{};      ///< HTML: what the text leads to, a relative address; may be empty
  std::string state{};  ///< HTML: worse, better, uncertain, failed or missing: a colour beside the words; may be empty
  std::string hint{};   ///< HTML: shown when the pointer rests on the text, for example a command
  std::string drawing{};      ///< HTML: inline SVG after the text
  bool not_eligible = false;  ///< not compared with the others of its row or column: grey
};

struct TableColumn {
  std::string group;  ///< heading over neighbouring columns of the same group; may be empty
  std::string head;
  bool published = false;
};

struct Table {
  std::string id;  ///< anchor, file name
  std::string title;
  std::string caption;
  std::vector<std::string> row_heads;  ///< headings of the leading text columns
  std::vector<TableColumn> columns;
  struct Row {
    std::vector<std::string> heads;
    std::vector<TableCell> cells;
    bool published = false;
  };
  std::vector<Row> rows;
  std::size_t page_width = 1000;  ///< HTML: a wider table is split by parts_of_width()
  bool side_by_side = false;      ///< HTML: the cells of its only column beside each other, because the table is narrow
  bool pages_only = false;        ///< too long for a terminal
};

/// Splits a table into parts of at most `width` characters if it is wider: between groups of columns, or between single
/// columns if there are no groups. The first part has the title, the last the caption.
std::vector<Table> parts_of_width(const Table& table, std::size_t width);

/// Groups of columns that do not fit `width` characters side by side are written below each other.
std::string to_terminal(const Table& table, bool color, std::size_t width = 1000);
std::string to_markdown(const Table& table);
std::string to_html(const Table& table);

}  // namespace scanbench::results
