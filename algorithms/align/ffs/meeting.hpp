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

/// A point of one scan is held by a point of the other that is within `reach` and has nearly the same direction (30
/// degrees), or by a rectangle within `reach` of both scans. A line does not hold scans, because they could slide
/// along it. Two scans meet if at least five points are held. A scan slides if the normals of its held points determine
/// fewer than three motions (see observable()).
///
/// A rectangle is drawn through the sides where they are: its size and place fit any. It holds the direction of every
/// side, and across a side only what another scan shows on the same side.
Meeting meeting_of(std::span<const Body> bodies, std::span<const Pose2> poses, const FieldPoints& real,
                   const VirtualScan& virtual_scan, double reach);

}  // namespace scanbench::align::ffs
