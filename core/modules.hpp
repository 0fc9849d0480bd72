// The interfaces of the pluggable algorithms. One virtual call per scan or map; results have a status; only a Mapper
// has state.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/line_map.hpp"
#include "core/match.hpp"
#include "core/scan.hpp"
#include "core/trace/trace.hpp"

namespace scanbench {

/// Finds the lines of one scan, in the sensor frame. Accepts any scan: without a valid beam there are no lines and all
/// labels are -1.
class LineExtractor {
 public:
  static constexpr std::string_view kKind = "extract";
  virtual ~LineExtractor() = default;
  virtual ScanLines extract(const Scan& scan, Trace& trace) const = 0;
};

/// Lines of many aligned scans and the scan points that support them (may be empty), world frame.
struct MergeInput {
  std::span<const MapLine> lines;
  std::span<const Vec2> points;
};

struct MergeResult {
  Status status = Status::converged;
  LineMap map;
  std::vector<int> labels;    ///< per input line the index of its map line; -1: dropped
  std::vector<int> cluster1;  ///< per input line its cluster of the first phase; empty if there is no such phase
  std::vector<int> cluster2;  ///< per input line its cluster of the second phase; empty if there is no such phase
};

/// Merges the lines of many scans into a map.
class SegmentMerger {
 public:
  static constexpr std::string_view kKind = "merge";
  virtual ~SegmentMerger() = default;
  virtual MergeResult merge(const MergeInput& input, Trace& trace) const = 0;
};

/// One scan with its lines.
struct Observation {
  const Scan& scan;
  const ScanLines& lines;
};

/// Finds the pose of one scan in the frame of another, starting from a guess. Accepts any two scans: without returns,
/// or with too little in common, the status is `no_match`.
class ScanMatcher {
 public:
  static constexpr std::string_view kKind = "match";
  virtual ~ScanMatcher() = default;
  virtual Match match(const Observation& reference, const Observation& current, const Pose2& guess,
                      Trace& trace) const = 0;
};

/// Poses of all scans, as many as were given.
struct Alignment {
  Status status = Status::converged;
  std::vector<Pose2> world_from_sensor;
  std::string message{};  ///< what a status other than `converged` means here; may be empty
};

/// Aligns all scans at once, starting from initial poses.
class Aligner {
 public:
  static constexpr std::string_view kKind = "align";
  virtual ~Aligner() = default;
  virtual Alignment align(std::span<const Observation> scans, std::span<const Pose2> initial, Trace& trace) const = 0;
};

/// What became of a scan that was inserted into a map.
struct Insertion {
  /// `converged`: the scan is in the map. `degenerate`: it is, and its pose is as guessed along some motion.
  /// `max_iterations`: it is, at a pose that still moved. `no_match`: it does not fit the map, or has no lines; the
  /// message says whether it was inserted all the same.
  Status status = Status::converged;
  Pose2 world_from_sensor;  ///< where the scan was placed; of a mapper that corrects no poses the guess
  int lines = 0;            ///< of the map with this scan
  std::string message{};    ///< what a status other than `converged` means here; may be empty
};

/// Builds a map scan by scan: the only kind with state. A map is ready after every scan.
class Mapper {
 public:
  static constexpr std::string_view kKind = "map";
  virtual ~Mapper() = default;
  /// `guess` is the scan's pose by odometry or by the slot before. Guesses that drift are as good as exact ones for a
  /// mapper that corrects poses: it uses the motion between them.
  virtual Insertion insert(const Observation& observation, const Pose2& guess, Trace& trace) = 0;
  virtual LineMap map() const = 0;
};

}  // namespace scanbench
