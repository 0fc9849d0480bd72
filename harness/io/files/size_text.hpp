// Numbers of bytes in messages.
#pragma once

#include <string>

namespace scanbench::io {

/// "8 MiB", "1.5 GiB", "312 B".
std::string size_text(double bytes);

}  // namespace scanbench::io
