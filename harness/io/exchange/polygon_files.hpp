// Writes the polygons of a cell's scans as a table (core/geometry/polygon.hpp).
#pragma once

#include <string>
#include <vector>

#include "core/scan.hpp"

namespace scanbench::io {

/// One row per segment: frame, segment, then the fields of its record in their order. Neighbours are joined with the
/// default rules of polygon_of().
std::string polygons_csv(const std::vector<ScanLines>& scans);

}  // namespace scanbench::io
