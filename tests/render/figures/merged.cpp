// Runs a merger on lines or on the result of a pipeline, and collects its trace.
#include "merged.hpp"

#include <cmath>

#include "core/modules.hpp"
#include "core/registry.hpp"
#include "tests/support/trace_recorder.hpp"

namespace scanbench::render::test {
namespace {

Merged merged(std::span<const MapLine> lines, std::span<const Vec2> points, const ParamSet& params) {
  support::TraceRecorder recorder("merge");
  Merged made;
  made.result.has_map = true;
  made.result.map = Registry<SegmentMerger>::make("mean_shift", params)->merge({lines, points}, recorder.trace).map;
  made.trace = std::move(recorder.all_rows);
  return made;
}

}  // namespace

Merged merged_by_mean_shift(std::span<const MapLine> lines, std::span<const Vec2> points, const ParamSet& params) {
  Merged made = merged(lines, points, params);
  ScanLines& frame = made.result.lines.emplace_back();
  for (const MapLine& line : lines) {
    LineFeature feature;
    feature.segment = line.segment;
    frame.lines.push_back(feature);
  }
  made.result.world_from_sensor = {Pose2()};
  return made;
}

Merged merged_by_mean_shift(const Recording& recording, const PipelineResult& found) {
  std::vector<MapLine> lines;
  const auto& poses = recording.truth->world_from_sensor;
  for (std::size_t f = 0; f < found.lines.size(); ++f)
    for (const LineFeature& line : found.lines[f].lines) lines.push_back({.segment = poses[f] * line.segment});
  Merged made = merged(lines, {}, {});
  made.result.lines = found.lines;
  made.result.world_from_sensor = poses;
  return made;
}

Recording blind_recording() {
  Recording recording;
  recording.observed.sensor.geometry = ScanGeometry(0.0, radians(1), 1);
  recording.observed.frames.push_back({0.0, {INFINITY}, Pose2()});
  return recording;
}

}  // namespace scanbench::render::test
