// Numbers as text and text as numbers, independent of the locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace scanbench {

/// Shortest decimal that reads back to the same double; "inf", "-inf", "nan".
std::string number_text(double value);

/// `text` as a finite number in plain decimal notation. Empty if anything else is in it: hexadecimal or octal digits,
/// inf, nan, spaces, a second sign.
std::optional<double> parse_number(std::string_view text);
/// `text` as a whole number without a plus sign. Empty if anything else is in it.
std::optional<long long> parse_integer(std::string_view text);

}  // namespace scanbench
