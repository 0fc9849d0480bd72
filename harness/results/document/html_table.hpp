// Tables as HTML: one table each, however wide, in a box that scrolls while its first column stays.
#pragma once

#include <string>

#include "harness/results/document/table.hpp"

namespace scanbench::results {

/// A section with the table, its title as the table's caption, and its caption below. The id of a column's metric is
/// shown when the pointer rests on its head.
std::string to_html(const Table& table);

}  // namespace scanbench::results
