// What a message shows of the output of a process.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace scanbench::io {

inline constexpr std::size_t kTailLines = 20;       ///< at most, from the end of the output
inline constexpr std::size_t kTailLineBytes = 300;  ///< that are shown of a line, apart from the note on what is not

/// The last kTailLines lines of an output. Of a line longer than kTailLineBytes the beginning and the end are shown,
/// and how many bytes are left out between them.
std::string output_tail(std::string_view output);

}  // namespace scanbench::io
