// Groups of scans that hold each other, and the message of an aligner if there are several groups.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/pose2.hpp"

namespace scanbench::align {

/// A graph with scans as nodes and an edge between two scans that meet.
class ScanGroups {
 public:
  explicit ScanGroups(std::size_t scans = 0);
  void join(std::size_t a, std::size_t b);

  /// Scans of each group in ascending order. Larger groups come first; of equally large ones, the group with the lowest
  /// scan.
  std::vector<std::vector<std::size_t>> groups() const;
  bool together() const { return groups().size() <= 1; }

  /// "2 groups of scans do not meet: 57 scans, and scans 3, 8, 12"; empty if all scans are in one group. Scans of
  /// groups of up to five are listed by frame; at most eight groups are named.
  std::string complaint() const;

 private:
  std::size_t root(std::size_t scan) const;

  std::vector<std::size_t> parent_;
};

/// The poses, moved together so that the first is initial[0], because an alignment determines only relative poses.
std::vector<Pose2> held_at_first(std::span<const Pose2> initial, std::span<const Pose2> poses);

/// A message that names the first scan whose pose is not finite or is beyond 1e9 m; empty if there is none.
std::string unusable_pose(std::span<const Pose2> poses);

}  // namespace scanbench::align
