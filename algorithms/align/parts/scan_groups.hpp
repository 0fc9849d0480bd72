// Groups of scans that hold each other, and what an aligner says when there are several.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/pose2.hpp"

namespace scanbench::align {

/// Scans as nodes, "these two meet" as edges.
class ScanGroups {
 public:
  explicit ScanGroups(std::size_t scans = 0);
  void join(std::size_t a, std::size_t b);

  /// Scans of each group in ascending order; larger groups first, of equally large ones that with the lower scan.
  std::vector<std::vector<std::size_t>> groups() const;
  bool together() const { return groups().size() <= 1; }

  /// "2 groups of scans do not meet: 57 scans, and scans 3, 8, 12"; empty if all are together. Groups of up to five
  /// scans are listed by frame, at most eight groups are named.
  std::string complaint() const;

 private:
  std::size_t root(std::size_t scan) const;

  std::vector<std::size_t> parent_;
};

/// The poses moved together such that the first is initial[0]: only relative poses are determined by an alignment.
std::vector<Pose2> held_at_first(std::span<const Pose2> initial, std::span<const Pose2> poses);

/// The first scan whose pose is not finite or lies beyond 1e9 m, as a message; empty if there is none.
std::string unusable_pose(std::span<const Pose2> poses);

}  // namespace scanbench::align
