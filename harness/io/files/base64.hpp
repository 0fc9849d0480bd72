// Base64 (RFC 4648, section 4), for pictures inside a page.
#pragma once

#include <string>
#include <string_view>

namespace scanbench::io {

/// The bytes as base64 with padding, on one line. Empty for no bytes.
std::string base64(std::string_view bytes);

}  // namespace scanbench::io
