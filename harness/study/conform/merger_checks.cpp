// Checks of segment mergers, on segment sets that break careless implementations.
#include "harness/study/conform/merger_checks.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "core/index.hpp"
#include "core/rng.hpp"
#include "core/special_values.hpp"
#include "harness/study/conform/scenes.hpp"

namespace scanbench::study::conform {
namespace {

using Mergers = Subject<SegmentMerger>;

bool is_finite(const Segment& s) {
  return s.a.allFinite() && s.b.allFinite();
}

void check_cluster_labels(const std::vector<MapLine>& lines, const MergeResult& result, Findings& findings) {
  findings.expect(result.labels.size() == lines.size(),
                  std::to_string(result.labels.size()) + " labels for " + std::to_string(lines.size()) + " segments");
  if (result.labels.size() != lines.size()) return;
  for (const auto* clusters : {&result.cluster1, &result.cluster2})
    findings.expect((clusters->empty() || clusters->size() == lines.size()) &&
                        std::ranges::all_of(*clusters, [](int c) { return c >= -1; }),
                    "the clusters of a phase are not one per segment, or one is below -1");
  std::vector<int> members(result.map.lines.size(), 0);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const int label = result.labels[i];
    const std::string place = "segment " + std::to_string(i);
    const bool valid = label >= -1 && label < static_cast<int>(result.map.lines.size());
    findings.expect(valid, place + " has the label " + std::to_string(label));
    findings.expect(label == -1 || is_finite(lines[i].segment), place + " is not finite but has a label");
    if (valid && label >= 0) ++members[as_index(label)];
  }
  for (std::size_t k = 0; k < members.size(); ++k)
    findings.expect(members[k] >= 1, "map line " + std::to_string(k) + " has no member");
}

void check_map(const MergeResult& result, Findings& findings) {
  for (std::size_t k = 0; k < result.map.lines.size(); ++k) {
    const MapLine& line = result.map.lines[k];
    const std::string place = "map line " + std::to_string(k);
    findings.expect(is_finite(line.segment) && line.covariance.allFinite(), place + " is not finite");
    findings.expect(line.members >= 1 && line.points >= 0, place + " has " + std::to_string(line.members) +
                                                               " members, " + std::to_string(line.points) + " points");
  }
}

/// An instance with its checks.
class CheckedMerger {
 public:
  CheckedMerger(const Mergers& subject, Findings& findings) : module_(subject.make({})), findings_(findings) {}

  MergeResult operator()(const std::vector<MapLine>& lines, Trace trace = {}) const {
    MergeResult result = module_->merge({lines, {}}, trace);
    check_cluster_labels(lines, result, findings_);
    check_map(result, findings_);
    return result;
  }

 private:
  std::unique_ptr<SegmentMerger> module_;
  Findings& findings_;
};

MapLine line(double x1, double y1, double x2, double y2) {
  MapLine result;
  result.segment = {{x1, y1}, {x2, y2}};
  result.points = 10;
  return result;
}

/// The walls of a room, each seen `copies` times with noise of `sigma` at both ends.
std::vector<MapLine> seen_room(int copies, double sigma, std::uint64_t seed) {
  std::vector<MapLine> lines;
  const auto walls = box(-3, -2, 4, 2.5);
  for (std::size_t w = 0; w < walls.size(); ++w)
    for (int c = 0; c < copies; ++c) {
      CounterRng rng(seed, RngStream::range, static_cast<std::uint32_t>(c), static_cast<std::uint32_t>(w));
      const auto jitter = [&] { return Vec2(sigma * rng.normal(), sigma * rng.normal()); };
      const Vec2 a = walls[w].a + jitter();
      const Vec2 b = walls[w].b + jitter();
      lines.push_back(line(a.x(), a.y(), b.x(), b.y()));
    }
  return lines;
}

/// Both maps have the same segments, in any order and direction.
bool same_map(const LineMap& a, const LineMap& b, double tolerance) {
  return a.lines.size() == b.lines.size() && std::ranges::all_of(a.lines, [&](const MapLine& x) {
           return std::ranges::any_of(b.lines, [&](const MapLine& y) {
             return is_near(x.segment, y.segment, tolerance) ||
                    is_near(x.segment, {y.segment.b, y.segment.a}, tolerance);
           });
         });
}

void merge_no_lines(const Mergers& subject, Findings& findings) {
  findings.expect(CheckedMerger(subject, findings)({}).map.lines.empty(), "no segments give map lines");
}

void merge_one_line(const Mergers& subject, Findings& findings) {
  findings.expect(CheckedMerger(subject, findings)({line(1, 1, 3, 2)}).map.lines.size() <= 1,
                  "one segment gives several");
}

void identical_segments(const Mergers& subject, Findings& findings) {
  const MergeResult result = CheckedMerger(subject, findings)(std::vector<MapLine>(8, line(1, 1, 3, 2)));
  findings.expect(result.map.lines.size() == 1,
                  "eight equal segments give " + std::to_string(result.map.lines.size()) + " map lines");
  if (result.map.lines.size() != 1) return;
  const Segment& s = result.map.lines[0].segment;
  const Segment truth{{1, 1}, {3, 2}};
  const LineDifference off = line_difference(line_through(s.a, s.b), line_through(truth.a, truth.b));
  findings.expect(off.rho <= 1e-3 && off.alpha <= 1e-3 && distance(s.midpoint(), truth) <= 1e-3,
                  "the map line of equal segments is elsewhere");
  findings.expect(std::ranges::count(result.labels, 0) == 8, "an equal segment is not a member of the map line");
}

void without_length(const Mergers& subject, Findings& findings) {
  const CheckedMerger merge(subject, findings);
  merge({line(1, 1, 1, 1)});
  merge(std::vector<MapLine>(5, line(1, 1, 1, 1)));
  auto lines = seen_room(4, 0.01, 1);
  lines.push_back(line(0, 0, 0, 0));
  merge(lines);
}

void not_finite(const Mergers& subject, Findings& findings) {
  const CheckedMerger merge(subject, findings);
  auto lines = seen_room(5, 0.01, 2);
  const MergeResult clean = merge(lines);
  for (const double bad : {kNaN, kInf, -kInf}) {
    lines.push_back(line(bad, 0, 1, 1));
    lines.push_back(line(0, 0, 1, bad));
  }
  findings.expect(same_map(clean.map, merge(lines).map, 1e-9), "segments that are not finite change the map");
}

void order(const Mergers& subject, Findings& findings) {
  const CheckedMerger merge(subject, findings);
  const auto lines = seen_room(6, 0.01, 3);
  std::vector<MapLine> shuffled;
  for (std::size_t i = 0; i < lines.size(); ++i) shuffled.push_back(lines[(i * 7) % lines.size()]);  // gcd(7, 24) = 1
  findings.expect(same_map(merge(lines).map, merge(shuffled).map, 1e-4),
                  "the same segments in another order give another map");
}

void merged_lines_move(const Mergers& subject, Findings& findings) {
  const CheckedMerger merge(subject, findings);
  auto lines = seen_room(6, 0.01, 4);
  LineMap expected = merge(lines).map;
  const Pose2 moved(3.0, -1.0, 0.4);
  for (auto* all : {&lines, &expected.lines})
    for (MapLine& l : *all) l.segment = moved * l.segment;
  findings.expect(same_map(expected, merge(lines).map, 1e-3), "the map does not move with the segments");
}

void merge_again(const Mergers& subject, Findings& findings) {
  const CheckedMerger merge(subject, findings);
  const auto lines = seen_room(6, 0.02, 5);
  const MergeResult first = merge(lines);
  const auto same = [&](const MergeResult& other) {
    return first.status == other.status && first.labels == other.labels &&
           std::ranges::equal(first.map.lines, other.map.lines, [](const MapLine& a, const MapLine& b) {
             return a.segment == b.segment && a.covariance == b.covariance && a.members == b.members &&
                    a.points == b.points;
           });
  };
  findings.expect(same(merge(lines)), "the same segments give another map the second time");
  merge(seen_room(3, 0.02, 6));
  findings.expect(same(merge(lines)), "the same segments give another map after other segments");
  findings.expect(same(CheckedMerger(subject, findings)(lines)), "a second instance makes another map");
  findings.expect(same(merge(lines, listening_trace())), "a trace that listens changes the map");
}

}  // namespace

const std::vector<Check<SegmentMerger>>& merger_checks() {
  static const std::vector<Check<SegmentMerger>> checks{
      {"NoSegmentsGiveAnEmptyMap", merge_no_lines},
      {"OneSegmentIsAnswered", merge_one_line},
      {"IdenticalSegmentsBecomeOneInTheirPlace", identical_segments},
      {"SegmentsWithoutLengthAreAnswered", without_length},
      {"SegmentsThatAreNotFiniteAreDroppedAndChangeNothingElse", not_finite},
      {"TheOrderOfTheSegmentsDoesNotMatter", order},
      {"TheMapMovesWithTheSegments", merged_lines_move},
      {"TheAnswerIsTheSameTwice", merge_again},
  };
  return checks;
}

}  // namespace scanbench::study::conform
