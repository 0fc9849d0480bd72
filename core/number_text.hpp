// Numbers as text, independent of the locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace scanbench {

/// Shortest decimal that reads back to the same double; "inf", "-inf", "nan".
std::string number_text(double value);

/// The whole of `text` as a finite number in plain decimal notation (no hex, no octal, no inf, no nan), else nothing.
std::optional<double> parse_number(std::string_view text);
std::optional<long long> parse_integer(std::string_view text);

}  // namespace scanbench
