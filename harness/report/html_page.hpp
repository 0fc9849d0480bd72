// Parts that all report pages share: the frame with its styles, the status of the cells, embedded figures, and how to
// get the numbers again. Markdown pages have the same parts.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "harness/report/figures.hpp"
#include "harness/report/page_input.hpp"

namespace scanbench::harness {

/// A complete, self-contained page.
std::string html_page(const std::string& title, const std::string& body);

/// A line of links to parts of the page: id and title of each.
std::string contents(const std::vector<std::pair<std::string, std::string>>& parts);

/// The number of cells that are ok, and a table of the others.
std::string html_status(const std::vector<CellLine>& cells);
std::string markdown_status(const std::vector<CellLine>& cells);

/// run/figures/<name>.svg as data, so that the ids of two figures cannot clash. The caption is HTML.
std::string html_figure(const std::filesystem::path& run, const FigureFile& figure, const std::string& caption);

/// "How to get these numbers again".
std::string html_facts(const std::vector<std::pair<std::string, std::string>>& facts);
std::string markdown_facts(const std::vector<std::pair<std::string, std::string>>& facts);

}  // namespace scanbench::harness
