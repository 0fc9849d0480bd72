// The interfaces of the pluggable algorithms. One virtual call per scan or map, results with a status, no state but
// Mapper's.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "core/line_map.hpp"
#include "core/match.hpp"
#include "core/pose2.hpp"
#include "core/scan.hpp"
#include "core/trace.hpp"

namespace scanbench {

/// Lines of one scan, in the sensor frame. Any scan has an answer: no valid beam gives no line and labels of -1.
class LineExtractor {
 public:
  static constexpr std::string_view kKind = "extract";
  virtual ~LineExtractor() = default;
  virtual ScanLines extract(const Scan& scan, Trace& trace) const = 0;
};

/// Lines of many aligned scans, and the scan points behind them (may be empty), world frame.
struct MergeInput {
  std::span<const MapLine> lines;
  std::span<const Vec2> points;
};

struct MergeResult {
  Status status = Status::converged;
  LineMap map;
  std::vector<int> labels;    ///< per input line the index of its map line, -1: dropped
  std::vector<int> cluster1;  ///< per input line, of the first phase where there is one, else empty
  std::vector<int> cluster2;  ///< per input line, of the second phase where there is one, else empty
};

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

/// The pose of one scan in the frame of another, from a guess. Any two scans have an answer: without returns, or with
/// too little in common, it is `no_match`.
class ScanMatcher {
 public:
  static constexpr std::string_view kKind = "match";
  virtual ~ScanMatcher() = default;
  virtual Match match(const Observation& reference, const Observation& current, const Pose2& guess,
                      Trace& trace) const = 0;
};

struct Alignment {
  Status status = Status::converged;
  std::vector<Pose2> world_from_sensor;
};

/// All scans at once.
class Aligner {
 public:
  static constexpr std::string_view kKind = "align";
  virtual ~Aligner() = default;
  virtual Alignment align(std::span<const Observation> scans, std::span<const Pose2> initial, Trace& trace) const = 0;
};

/// Incremental: the only kind with state.
class Mapper {
 public:
  static constexpr std::string_view kKind = "map";
  virtual ~Mapper() = default;
  virtual void insert(const Observation& observation, const Pose2& guess, Trace& trace) = 0;
  virtual LineMap map() const = 0;
};

}  // namespace scanbench
