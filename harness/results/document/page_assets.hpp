// What makes pages look and behave alike: light and dark, on a phone, on paper.
#pragma once

#include <string_view>

namespace scanbench::results {

/// CSS for a style element.
std::string_view page_style();

/// JavaScript for a script element: tables sort, filter and can be saved, figures open large.
std::string_view page_script();

}  // namespace scanbench::results
