// The results of one pipeline on one recording, as metrics and figures read them.
#pragma once

#include <vector>

#include "core/line_map.hpp"
#include "core/match.hpp"
#include "core/scan.hpp"
#include "core/trace/stage_time.hpp"

namespace scanbench {

/// The clusters and the map line that a line of a frame was merged into (-1: none).
struct MergeLabel {
  int frame = -1;
  int line = -1;
  int cluster1 = -1;
  int cluster2 = -1;
  int map_line = -1;
};

/// One match of two frames, as a `match` slot made it.
struct FrameMatch {
  int frame = -1;
  int reference = -1;  ///< frame that it was matched with
  Match match;
};

struct PipelineResult {
  std::vector<ScanLines> lines;          ///< per frame, sensor frame
  std::vector<Pose2> world_from_sensor;  ///< estimated, per frame; empty if no slot estimates or uses poses
  std::vector<FrameMatch> matches;       ///< in the order of their frames; empty if no slot matches
  std::vector<FrameMatch> skip_matches;  ///< of frames with the last but one; empty if no metric requests them
  bool has_map = false;                  ///< a slot makes a map, which may be empty
  LineMap map;                           ///< empty if no slot makes one
  std::vector<MergeLabel> merge_labels;
  std::vector<StageTime> times;
};

}  // namespace scanbench
