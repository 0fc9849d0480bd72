// What a pipeline leaves behind for one recording: read by metrics and figures.
#pragma once

#include <string>
#include <vector>

#include "core/line_map.hpp"
#include "core/match.hpp"
#include "core/scan.hpp"

namespace scanbench {

/// Which line of which frame went into which cluster and map line (-1: none).
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

/// Thread CPU time of one stage of one module on one frame; frame -1: the whole recording.
struct StageTime {
  std::string stage;
  int frame = -1;
  double seconds = 0.0;
};

struct PipelineResult {
  std::vector<ScanLines> lines;          ///< per frame, sensor frame
  std::vector<Pose2> world_from_sensor;  ///< per frame, as estimated; empty if no slot estimates or uses poses
  std::vector<FrameMatch> matches;       ///< in the order of their frames; empty if no slot matches
  bool has_map = false;                  ///< a slot makes a map, which may come out empty
  LineMap map;                           ///< empty if no slot makes one
  std::vector<MergeLabel> merge_labels;
  std::vector<StageTime> times;
};

}  // namespace scanbench
