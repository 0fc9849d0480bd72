// Tables, and how they are written as terminal text and Markdown. html_table.hpp writes them as HTML.
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
  std::string metric{};  ///< the id of the metric of its values; may be empty
  std::string words{};   ///< pages: instead of the metric's id, in the group if there is one, else in the head
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
    std::string note{};  ///< "not converged in 1 of 6": in parentheses after the first heading, below it in HTML
    std::string link{};  ///< HTML: what the first heading leads to, a relative address; may be empty
  };
  std::vector<Row> rows;
  bool side_by_side = false;  ///< HTML: the cells of its only column beside each other, because the table is narrow
  bool pages_only = false;    ///< too long for a terminal
};

/// Neighbouring columns of one group.
struct ColumnGroup {
  std::string group;
  std::size_t first = 0;
  std::size_t count = 0;
};

/// The groups of a table's columns, in order. Columns without a group are groups too, one for each run of them.
std::vector<ColumnGroup> column_groups(const Table& table);

/// True if a column has a group.
bool has_groups(const Table& table);

/// The group and the head of a column as pages show them.
std::string page_group(const TableColumn& column);
std::string page_head(const TableColumn& column);

/// Splits a table into parts of at most `width` characters if it is wider: between groups of columns, or between single
/// columns if there are no groups. The first part has the title, the last the caption.
std::vector<Table> parts_of_width(const Table& table, std::size_t width);

/// Groups of columns that do not fit `width` characters side by side are written below each other.
std::string to_terminal(const Table& table, bool color, std::size_t width = 1000);
std::string to_markdown(const Table& table);

}  // namespace scanbench::results
