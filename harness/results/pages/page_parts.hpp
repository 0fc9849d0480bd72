// Parts that the pages of runs and benchmarks share: the status of the cells, figures, and the meaning of metrics.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "harness/results/document/document.hpp"
#include "harness/results/figures/figures.hpp"
#include "harness/results/tables/comparable_rows.hpp"

namespace scanbench::results {

/// The number of cells that are ok, and a table of the others.
Blocks status_blocks(const std::vector<CellLine>& cells);

/// A table of the remarks on cells that are ok; empty if there are none.
Blocks remark_blocks(const std::vector<CellLine>& cells);

/// run/figures/<name>.svg. HTML gets it as data, so that the ids of two figures cannot clash. `number`, for example
/// "Figure 1", is before the caption; may be empty.
Picture run_picture(const std::filesystem::path& run, const FigureFile& figure, const std::string& number = "");

/// What these metrics mean, with their labels, names and units; unknown names are left out.
Definitions definitions_of(const std::set<std::string>& metrics);

}  // namespace scanbench::results
