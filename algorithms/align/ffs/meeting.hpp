// Which scans hold each other when a simulation ends, and which can slide.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "algorithms/align/ffs/body.hpp"
#include "algorithms/align/ffs/force_field.hpp"
#include "algorithms/align/ffs/simulation.hpp"
#include "algorithms/align/parts/scan_groups.hpp"

namespace scanbench::align::ffs {

struct Meeting {
  ScanGroups groups;
  std::vector<std::size_t> sliding;  ///< scans that meet others and yet could move along or about them
};

/// Two scans meet if at least five points of them lie within `reach` of a point of the other with nearly the same
/// direction (30 degrees), or of the same rectangle (a line does not hold: both could slide along it). A scan slides if
/// the normals of its points that have such a partner determine fewer than three motions (see observable()).
Meeting meeting_of(std::span<const Body> bodies, std::span<const Pose2> poses, const FieldPoints& real,
                   const VirtualScan& virtual_scan, double reach);

}  // namespace scanbench::align::ffs
