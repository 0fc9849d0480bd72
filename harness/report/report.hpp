// The report of a run: one self-contained HTML page and the same in Markdown.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/report/page_input.hpp"

namespace scanbench::harness {

/// Self-contained HTML. SVG figures are embedded as data, so that their ids cannot clash.
std::string report_html(const ReportInput& input);

std::string report_markdown(const ReportInput& input);

}  // namespace scanbench::harness
