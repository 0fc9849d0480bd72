// Writes documents as HTML, with the styles and widgets of all pages: tables sort, filter and can be saved; figures
// open large.
#pragma once

#include <string>

#include "harness/results/document/document.hpp"

namespace scanbench::results {

/// A complete, self-contained page: no request, light and dark, readable without JavaScript.
std::string to_html(const Document& document);

/// Blocks as they are inside a page.
std::string to_html(const Blocks& blocks);

}  // namespace scanbench::results
