// map_truth: a merged map against the true walls: how much of them it covers, what it adds, how often it repeats,
// breaks or fuses them, and how exact its lines are.
//
// Only the visible part of a wall counts: where at least 3 returns per 10 cm came from over the whole run. Walls that
// are on one line and touch are one surface throughout: a map is right to join them, because no scan shows the seam.
// Collinear walls with a gap between them (a corridor with doors) are separate for lines_per_wall and fragments. One
// line over both of them is not over-merged, because that needs walls on different lines; it lowers true_share by the
// gap that it fills. The map is compared without an alignment: its frame is that of the truth.
//
// Whether a line is over-merged is decided by its members, the scan lines merged into it, and not by its place: the
// line halfway between two walls is far from both.
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/geometry/interval.hpp"
#include "core/index.hpp"
#include "core/registry.hpp"
#include "metrics/map_members.hpp"
#include "metrics/rows.hpp"
#include "metrics/walls/surfaces.hpp"
#include "metrics/walls/visible_walls.hpp"

namespace scanbench::metrics {
namespace {

constexpr double kNear = 0.05;
constexpr double kFar = 0.10;
constexpr int kOneIn = 5;          // a line fuses two walls if one in this many members comes from each
constexpr double kOneView = 0.30;  // visible parts with a smaller gap between them need one line, not two

/// Distance of p from the infinite line of s.
double line_distance(const Vec2& p, const Segment& s) {
  return std::fabs(cross(s.direction(), p - s.a));
}

/// The distance between the lines of two nearly parallel segments.
double offset_between(const Segment& a, const Segment& b) {
  return std::max(line_distance(a.midpoint(), b), line_distance(b.midpoint(), a));
}

/// The part of a surface that a map line represents: near the line and between the projections of its ends. Absent if
/// it is empty.
std::optional<Interval> represented_part(const Segment& surface, const Segment& line) {
  const auto near = part_near(surface, line, kFar);
  if (!near) return std::nullopt;
  const Interval part = intersection(*near, projection(line, surface.a, surface.direction()));
  if (!(part.high > part.low)) return std::nullopt;
  return part;
}

/// One map line and the surface that it overlaps most.
struct Assigned {
  std::size_t line = 0;
  Interval part;
};

class MapTruth : public MetricFamily {
 public:
  struct Params {
    double max_angle_deg = 10.0;
    double min_hits_per_m = 30.0;
    double over_merge_m = 0.15;
    static auto fields() {
      return std::tuple{field("max_angle_deg", &Params::max_angle_deg, between(0, 90), "deg",
                              "largest angle between a map line and the wall that it represents"),
                        field("min_hits_per_m", &Params::min_hits_per_m, at_least(0), "1/m",
                              "returns over the run that make a part of a wall visible"),
                        field("over_merge_m", &Params::over_merge_m, at_least(0), "m",
                              "walls farther apart than this must not share a map line")};
    }
  };

  explicit MapTruth(const Params& params) : params_(params) {}

  std::vector<MetricDescription> describe() const override {
    using enum Direction;
    // map_offset and map_angle have no direction: they are means over the lines of the map, and a map that misses the
    // difficult walls has smaller errors than a complete one.
    return {share({"covered_5cm", "walls covered within 5 cm", "", higher_is_better, 0.005,
                   "share of the visible wall length within 5 cm of a map line of its direction"}),
            share({"covered_10cm", "walls covered within 10 cm", "", higher_is_better, 0.005,
                   "share of the visible wall length within 10 cm of a map line of its direction"}),
            share({"true_share_5cm", "map within 5 cm of walls", "", higher_is_better, 0.005,
                   "share of the map's length within 5 cm of a wall"}),
            share({"true_share_10cm", "map within 10 cm of walls", "", higher_is_better, 0.005,
                   "share of the map's length within 10 cm of a wall"}),
            {"lines_per_wall", "map lines per wall", "", target, 0.02,
             "map lines that represent a visible wall, per visible wall; 1 is the best", false, 1.0},
            {"duplicates", "duplicate lines", "", lower_is_better, 0.0,
             "map lines that repeat longer lines of the same wall over more than half of their length"},
            {"fragments", "fragments", "", lower_is_better, 0.0,
             "lines of a wall in excess of one for each visible part of it"},
            {"over_merged", "over-merged lines", "", lower_is_better, 0.0,
             "map lines with members, a fifth or more each, from two parallel walls on different lines"},
            {"unassigned", "lines on no wall", "", lower_is_better, 0.0, "map lines that represent no wall"},
            {"map_offset", "map offset error", "m", neither, 0.001,
             "distance of map lines' midpoints from their wall's line, mean weighted by the lines' lengths"},
            {"map_angle", "map angle error", "deg", neither, 0.05,
             "angle between map lines and their walls, mean weighted by the lines' lengths"},
            {"visible_m", "visible wall length", "m", neither, 0.0, "visible length of all walls"}};
  }

  bool applies(const MetricInput& input) const override { return input.result.has_map && knows_walls(input); }

  std::vector<MetricRow> evaluate(const MetricInput& input) const override {
    SCANBENCH_ASSERT(knows_walls(input));
    const Surfaces surfaces = join_walls(input.truth->walls);
    const std::vector<std::vector<Interval>> visible = visible_parts(input, surfaces, params_.min_hits_per_m);
    std::vector<Segment> map;
    for (const MapLine& line : input.result.map.lines)
      if (line.segment.length() > 0) map.push_back(line.segment);

    const auto n_visible = std::ranges::count_if(visible, [](const auto& parts) { return !parts.empty(); });
    double visible_m = 0.0;
    for (const auto& parts : visible) visible_m += total_length(parts);

    Rows rows(describe());
    rows.add("covered_5cm", kAll, ratio(covered(map, surfaces, visible, kNear), visible_m), n_visible);
    rows.add("covered_10cm", kAll, ratio(covered(map, surfaces, visible, kFar), visible_m), n_visible);
    rows.add("true_share_5cm", kAll, true_share(map, surfaces, kNear), std::ssize(map));
    rows.add("true_share_10cm", kAll, true_share(map, surfaces, kFar), std::ssize(map));
    add_assignment(rows, map, surfaces, visible, n_visible, over_merged(input, surfaces));
    rows.add("visible_m", kAll, visible_m, n_visible);
    return rows.take();
  }

 private:
  bool alike(const Segment& a, const Segment& b) const { return angle_between(a, b) <= radians(params_.max_angle_deg); }

  double covered(const std::vector<Segment>& map, const Surfaces& surfaces,
                 const std::vector<std::vector<Interval>>& visible, double distance) const {
    double sum = 0.0;
    for (std::size_t s = 0; s < surfaces.segments.size(); ++s) {
      std::vector<Interval> parts;
      for (const Segment& line : map)
        if (alike(line, surfaces.segments[s]))
          if (const auto part = part_near(surfaces.segments[s], line, distance)) parts.push_back(*part);
      sum += common_length(unite(std::move(parts)), visible[s]);
    }
    return sum;
  }

  static double true_share(const std::vector<Segment>& map, const Surfaces& surfaces, double distance) {
    double near = 0.0;
    double all = 0.0;
    for (const Segment& line : map) {
      std::vector<Interval> parts;
      for (const Segment& surface : surfaces.segments)
        if (const auto part = part_near(line, surface, distance)) parts.push_back(*part);
      near += total_length(unite(std::move(parts)));
      all += line.length();
    }
    return ratio(near, all);
  }

  void add_assignment(Rows& rows, const std::vector<Segment>& map, const Surfaces& surfaces,
                      const std::vector<std::vector<Interval>>& visible, std::int64_t n_visible,
                      double n_over_merged) const {
    const std::size_t n_surfaces = surfaces.segments.size();
    std::vector<std::vector<Assigned>> assigned(n_surfaces);
    Mean offset, angle;
    for (std::size_t k = 0; k < map.size(); ++k) {
      std::size_t best = n_surfaces;
      Interval best_part;
      for (std::size_t s = 0; s < n_surfaces; ++s) {
        const Segment& surface = surfaces.segments[s];
        if (!alike(map[k], surface)) continue;
        const auto part = represented_part(surface, map[k]);
        if (!part) continue;
        if (best < n_surfaces && part->length() <= best_part.length()) continue;
        best = s;
        best_part = *part;
      }
      if (best == n_surfaces) continue;
      assigned[best].push_back({k, best_part});
      offset.add(line_distance(map[k].midpoint(), surfaces.segments[best]), map[k].length());
      angle.add(degrees(angle_between(map[k], surfaces.segments[best])), map[k].length());
    }

    std::int64_t duplicates = 0, fragments = 0, on_visible = 0;
    for (std::size_t s = 0; s < n_surfaces; ++s) {
      std::ranges::stable_sort(assigned[s], std::ranges::greater{}, [](const Assigned& a) { return a.part.length(); });
      std::vector<Interval> kept;
      std::int64_t originals = 0;
      for (const Assigned& a : assigned[s]) {
        if (common_length({&a.part, 1}, unite(kept)) > 0.5 * a.part.length()) {
          ++duplicates;
          continue;
        }
        ++originals;
        kept.push_back(a.part);
      }
      const auto views = std::max(std::ssize(unite(visible[s], kOneView)), std::ptrdiff_t{1});
      fragments += std::max(originals - views, std::int64_t{0});
      if (!visible[s].empty()) on_visible += std::ssize(assigned[s]);
    }

    const std::int64_t n_assigned = offset.count();
    rows.add("lines_per_wall", kAll, ratio(number(on_visible), number(n_visible)), n_visible);
    rows.add("duplicates", kAll, number(duplicates), n_assigned);
    rows.add("fragments", kAll, number(fragments), n_assigned);
    rows.add("over_merged", kAll, n_over_merged, std::ssize(map));
    rows.add("unassigned", kAll, number(std::ssize(map) - n_assigned), std::ssize(map));
    rows.add("map_offset", kAll, offset);
    rows.add("map_angle", kAll, angle);
  }

  /// Map lines with a fifth or more of their members from each of two parallel walls too far apart for one map line;
  /// undefined if the members of the map's lines are unknown. Walls that cross have no distance: a scan line that runs
  /// around a corner is the extractor's error.
  double over_merged(const MetricInput& input, const Surfaces& surfaces) const {
    const auto members = members_by_surface(input, surfaces, radians(params_.max_angle_deg));
    if (members.empty() && !input.result.map.lines.empty()) return kUndefined;
    return number(std::ranges::count_if(members, [&](const MemberCounts& counts) { return fuses(counts, surfaces); }));
  }

  bool fuses(const MemberCounts& counts, const Surfaces& surfaces) const {
    int all = 0;
    for (const auto& [surface, count] : counts) all += count;
    const auto segment = [&](int surface) { return surfaces.segments[as_index(surface)]; };
    // The pieces of a wall with doors in it count together.
    std::vector<Segment> sources;
    for (const auto& [surface, unused] : counts) {
      if (surface < 0) continue;
      int on_this_line = 0;
      for (const auto& [other, count] : counts)
        if (other >= 0 && alike(segment(surface), segment(other)) &&
            offset_between(segment(surface), segment(other)) <= params_.over_merge_m)
          on_this_line += count;
      if (on_this_line * kOneIn >= all) sources.push_back(segment(surface));
    }
    for (std::size_t i = 0; i < sources.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (alike(sources[i], sources[j]) && offset_between(sources[i], sources[j]) > params_.over_merge_m) return true;
    return false;
  }

  Params params_;
};

SCANBENCH_REGISTER(
    MetricFamily, MapTruth,
    {.name = "map_truth",
     .summary = "a map against the true walls: coverage, false length, repeats, fragments, over-merging, errors",
     .reference = "this project"});

}  // namespace
}  // namespace scanbench::metrics
