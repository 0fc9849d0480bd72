// Parts that the pages of runs and benchmarks share: the status of the cells, and figures.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "harness/report/figures.hpp"
#include "harness/report/page_input.hpp"

namespace scanbench::harness {

/// The number of cells that are ok, and a table of the others.
std::string html_status(const std::vector<CellLine>& cells);
std::string markdown_status(const std::vector<CellLine>& cells);

/// A table of the remarks on cells that are ok; empty if there are none.
std::string html_remarks(const std::vector<CellLine>& cells);
std::string markdown_remarks(const std::vector<CellLine>& cells);

/// run/figures/<name>.svg as data, so that the ids of two figures cannot clash. The caption is HTML.
std::string html_figure(const std::filesystem::path& run, const FigureFile& figure, const std::string& caption);

/// What these metrics mean, with their units; unknown names are left out. Empty without any.
std::string html_definitions(const std::set<std::string>& metrics);

}  // namespace scanbench::harness
