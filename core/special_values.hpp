// Infinity and NaN of double, under one name each.
#pragma once

#include <limits>

namespace scanbench {

inline constexpr double kInf = std::numeric_limits<double>::infinity();
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace scanbench
