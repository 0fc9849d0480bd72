// Counts the members of map lines, each attributed to a surface by its beams or, without beams, by its true place.
#include "metrics/map_members.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "core/special_values.hpp"

namespace scanbench::metrics {
namespace {

/// Per line of a frame the surface that most of its beams hit, -1 if none of them hits any.
std::vector<int> surfaces_by_beams(const MetricInput& input, std::size_t frame, const Surfaces& surfaces) {
  const ScanLines& found = input.result.lines[frame];
  std::vector<std::map<int, int>> hits(found.lines.size());
  SCANBENCH_ASSERT((frame + 1) * found.labels.size() <= input.truth->wall_ids.size());
  const std::size_t first_beam = frame * found.labels.size();
  for (std::size_t i = 0; i < found.labels.size(); ++i) {
    const std::int32_t wall = input.truth->wall_ids[first_beam + i];
    if (found.labels[i] >= 0 && wall >= 0) ++hits[as_index(found.labels[i])][surfaces.of_wall[as_index(wall)]];
  }
  std::vector<int> of_line;
  for (const auto& per_surface : hits) {
    int best = -1, most = 0;
    for (const auto& [surface, count] : per_surface)
      if (count > most) best = surface, most = count;
    of_line.push_back(best);
  }
  return of_line;
}

/// The surface of the line's direction that its midpoint is nearest to, world frame; -1 if none has its direction.
int nearest_surface(const Segment& line, const Surfaces& surfaces, double max_angle_rad) {
  int best = -1;
  double least = kInf;
  for (std::size_t s = 0; s < surfaces.segments.size(); ++s) {
    if (angle_between(line, surfaces.segments[s]) > max_angle_rad) continue;
    const double d = distance(line.midpoint(), surfaces.segments[s]);
    if (d >= least) continue;
    best = static_cast<int>(s);
    least = d;
  }
  return best;
}

std::vector<int> surfaces_by_place(const MetricInput& input, std::size_t frame, const Surfaces& surfaces,
                                   double max_angle_rad) {
  SCANBENCH_ASSERT(frame < input.truth->world_from_sensor.size());
  std::vector<int> of_line;
  for (const LineFeature& line : input.result.lines[frame].lines)
    of_line.push_back(nearest_surface(input.truth->world_from_sensor[frame] * line.segment, surfaces, max_angle_rad));
  return of_line;
}

}  // namespace

std::vector<MemberCounts> members_by_surface(const MetricInput& input, const Surfaces& surfaces, double max_angle_rad) {
  const PipelineResult& result = input.result;
  if (result.merge_labels.empty()) return {};
  std::vector<std::vector<int>> surface_of(result.lines.size());
  for (std::size_t f = 0; f < result.lines.size(); ++f)
    surface_of[f] = input.truth->wall_ids.empty() ? surfaces_by_place(input, f, surfaces, max_angle_rad)
                                                  : surfaces_by_beams(input, f, surfaces);
  std::vector<MemberCounts> members(result.map.lines.size());
  for (const MergeLabel& label : result.merge_labels) {
    if (label.map_line < 0) continue;
    const auto frame = as_index(label.frame), line = as_index(label.line), map_line = as_index(label.map_line);
    SCANBENCH_ASSERT(frame < surface_of.size() && line < surface_of[frame].size() && map_line < members.size());
    ++members[map_line][surface_of[frame][line]];
  }
  return members;
}

}  // namespace scanbench::metrics
