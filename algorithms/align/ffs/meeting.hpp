// Finds which scans hold each other at the end of a simulation, and which of them can slide.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "algorithms/align/ffs/body.hpp"
#include "algorithms/align/ffs/force_field.hpp"
#include "algorithms/align/ffs/virtual_scan.hpp"
#include "algorithms/align/parts/scan_groups.hpp"

namespace scanbench::align::ffs {

struct Meeting {
  ScanGroups groups;
  std::vector<std::size_t> sliding;  ///< scans that meet others but could still move along or about them
};

/// Two scans meet if at least five of their points are within `reach` of a point of the other with nearly the same
/// direction (30 degrees), or of the same rectangle. A line does not hold scans, because both could slide along it. A
/// scan slides if the normals of its points with such a partner determine fewer than three motions (see observable()).
Meeting meeting_of(std::span<const Body> bodies, std::span<const Pose2> poses, const FieldPoints& real,
                   const VirtualScan& virtual_scan, double reach);

}  // namespace scanbench::align::ffs
