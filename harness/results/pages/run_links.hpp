// Links from the pages of a run to its files: cells, recordings, tables, pictures and the scans in the player.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/results/document/document.hpp"
#include "harness/results/document/table.hpp"
#include "harness/results/figures/figures.hpp"
#include "harness/results/tables/comparable_rows.hpp"

namespace scanbench::results {

/// The page that plays the scans of a run, if the run has one (`report --scans`).
inline constexpr const char* kScansPage = "scans.html";

/// The text with a link to the player from every number of a scan: "scan 15", "the worst one (13)". The player shows
/// the first seed. Without `scans.html` in the run, the text alone.
Prose with_scan_links(const std::filesystem::path& run, const std::string& scenario, const std::string& text);

/// The caption of a figure, with links to the forms that its folder has: SVG, PNG, PDF.
Prose figure_caption(const std::filesystem::path& run, const FigureFile& figure);

/// Leads from the pipelines of a table to the folders of their cells in the scenario.
void link_pipelines(Table& table, const std::string& scenario, const std::vector<CellLine>& cells);

/// The tables, pages and folders that the run has, and in HTML a table with the folder of every cell and recording. No
/// file is linked that does not exist, but those that are written together with the page.
Blocks file_blocks(const std::filesystem::path& run, const std::vector<CellLine>& cells);

}  // namespace scanbench::results
