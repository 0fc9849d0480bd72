// Texts of unknown origin as code points.
#pragma once

#include <cstddef>
#include <string_view>

namespace scanbench::render {

/// The code point at `at`, which moves behind it; U+FFFD for malformed bytes, a space for control characters.
char32_t next_code_point(std::string_view text, std::size_t& at);

}  // namespace scanbench::render
