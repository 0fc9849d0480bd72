// The unit in which the numbers of an axis are written.
#pragma once

#include <string>

namespace scanbench::render {

struct ShownUnit {
  std::string text;       ///< "mm", "°"; empty for counts and shares
  double per_data = 1.0;  ///< shown numbers = this times the data
};

/// The unit for data in `unit` between `low` and `high`, so that its numbers have few zeros: metres below 0.1 m become
/// millimetres, and times are in the largest of µs, ms and s in which they reach 1. The middle of the decades decides
/// on an axis with `log`. Other units stay as they are, with their usual sign.
ShownUnit shown_unit(const std::string& unit, double low, double high, bool log);

/// "offset error [mm]"; the label alone without a unit.
std::string with_unit(const std::string& label, const std::string& unit);

}  // namespace scanbench::render
