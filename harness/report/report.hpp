// The report of a run: one self-contained HTML page and the same in Markdown.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/report/page_input.hpp"

namespace scanbench::harness {

/// HTML with styles and figures inside: it can be mailed. SVG figures are embedded as data, so their ids cannot meet.
std::string report_html(const ReportInput& input);

std::string report_markdown(const ReportInput& input);

}  // namespace scanbench::harness
