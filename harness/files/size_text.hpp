// Numbers of bytes in messages.
#pragma once

#include <string>

namespace scanbench::harness {

/// "8 MiB", "1.5 GiB", "312 B".
std::string size_text(double bytes);

}  // namespace scanbench::harness
