// dse: maps of generalized polylines by discrete segment evolution (Lakaemper, Latecki & Wolter, "Geometric robot
// mapping", 2005). docs/algorithms/dse.md.
//
// Departures. Merging looks at the strokes near the scan only: farther ones have not changed since the last scan, and
// the main directions are those of the recent part of the map anyway. A scan that does not meet the map is reported and
// inserted only where the map has nothing that it could contradict.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/map/dse/alignment.hpp"
#include "algorithms/map/dse/neighbours.hpp"
#include "algorithms/map/dse/pairing.hpp"
#include "algorithms/map/dse/polylines.hpp"
#include "algorithms/map/dse/simplification.hpp"
#include "algorithms/map/dse/stroke_map.hpp"
#include "algorithms/map/dse/vertex_insertion.hpp"
#include "algorithms/map/parts/prediction.hpp"
#include "algorithms/map/parts/scan_segments.hpp"
#include "algorithms/map/parts/step_matching.hpp"
#include "core/contracts/map_trace.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

using namespace mapping;
using namespace mapping::dse;

constexpr double kPolylineGapM = 0.5;  // D.6 of the paper's reconstruction: a longer gap ends a polyline
constexpr double kNovelM = 1.0;        // a scan without a line of the map so near is in a part that has no map yet

class Dse final : public Mapper {
 public:
  struct Params {
    double pairing_threshold_m = 0.002;
    double simplification_threshold_m = 0.001;
    double k = 100.0;
    CostForm cost = CostForm::ratio_of_all;
    double max_gap_m = 0.3;
    double max_apart_m = 0.07;
    int most_children = 3;
    Placement placement = Placement::by_evidence;
    bool same_side = true;
    int memory_scans = 50;
    double peak_share = 0.10;
    double peak_apart_deg = 10.0;
    double vertex_reach_m = 0.2;
    double vertex_apart_m = 0.05;
    std::string alignment = "end_points";
    PredictionKind prediction = PredictionKind::odometry;
    std::string step_matcher = "none";
    double gate_m = 0.5;
    double min_share = 0.3;
    double search_deg = 0.0;
    double min_length_m = 0.0;
    int min_members = 1;
    static auto fields();
  };

  explicit Dse(const Params& p)
      : params_(p),
        merge_{.form = p.cost, .k = p.k, .max_gap_m = p.max_gap_m, .max_apart_m = p.max_apart_m},
        insertion_{.reach_m = p.vertex_reach_m, .apart_m = p.vertex_apart_m},
        registration_{.wide_gate_m = p.gate_m,
                      .narrow_gate_m = std::min(p.gate_m, 0.1),
                      .least_share = p.min_share,
                      .search_rad = radians(p.search_deg)},
        aligner_(p.alignment,
                 {.insertion = insertion_, .extent_m = 0.2, .angle_rad = radians(20.0), .same_side = p.same_side},
                 registration_),
        prediction_(p.prediction),
        steps_(p.step_matcher, "step_matcher", radians(p.search_deg)) {}

  Insertion insert(const Observation& observation, const Pose2& guess, Trace& trace) override;
  LineMap map() const override;

 private:
  std::vector<Stroke> strokes_of(const Observation& observation) const;
  Registration locate(const Observation& observation, const std::vector<Stroke>& scan, const Pose2& predicted) const;
  bool novel(const std::vector<Stroke>& placed) const;
  void merge(std::vector<Stroke> placed, InsertionRow& row, Trace& trace);
  std::vector<Vec2> directions(const std::vector<Stroke>& placed, Trace& trace) const;
  void replace(const std::vector<std::size_t>& old, const std::vector<Stroke>& now, Trace& trace);
  Insertion outcome(Status status, const Pose2& map_from_sensor, std::string message);

  Params params_;
  MergeRule merge_;
  InsertionRule insertion_;
  RegistrationRule registration_;
  MapAligner aligner_;
  Prediction prediction_;
  StepMatching steps_;
  Pose2 world_from_map_;
  StrokeMap map_;
  int step_ = -1;
};

auto Dse::Params::fields() {
  return std::tuple{
      field("pairing_threshold_m", &Params::pairing_threshold_m, at_least(0), "m",
            "T_p: a map segment and a scan segment that cost less have a child; 0: none"),
      field("simplification_threshold_m", &Params::simplification_threshold_m, at_least(0), "m",
            "T_s: pairs that cost less are merged, cheapest first; 0: none"),
      field("k", &Params::k, at_least(0), "", "K of the cost, balances angles and metres"),
      choice("cost", &Params::cost,
             {{CostForm::ratio_of_all, "ratio_of_all"},
              {CostForm::ratio_of_distances, "ratio_of_distances"},
              {CostForm::ratio_added, "ratio_added"}},
             "place of the length ratio in the cost, which the print does not show"),
      field("max_gap_m", &Params::max_gap_m, at_least(0), "m", "largest gap that a merged segment may bridge"),
      field("max_apart_m", &Params::max_apart_m, above(0), "m",
            "largest distance of an end of a segment from the merged one; the paper has no limit"),
      field("most_children", &Params::most_children, between(1, 1000), "", "children of a segment at most"),
      choice("placement", &Params::placement,
             {{Placement::by_evidence, "by_evidence"}, {Placement::by_length, "by_length"}},
             "weights of two segments where their common line is placed: points, or lengths as in the paper"),
      field("same_side", &Params::same_side, "segments seen from opposite sides are different surfaces"),
      field("memory_scans", &Params::memory_scans, between(1, 1e9), "",
            "t_m: segments created in so many last scans determine the main directions"),
      field("peak_share", &Params::peak_share, between(0, 1), "",
            "share of the recent length that makes a direction a main direction"),
      field("peak_apart_deg", &Params::peak_apart_deg, between(0, 90), "deg", "smallest angle between main directions"),
      field("vertex_reach_m", &Params::vertex_reach_m, at_least(0), "m",
            "farthest end point that is projected as a vertex"),
      field("vertex_apart_m", &Params::vertex_apart_m, at_least(0), "m", "smallest distance of a vertex from others"),
      field("alignment", &Params::alignment,
            "end_points (the paper's ICP), none (poses are taken as predicted) or the name of a matcher, which gets "
            "the map as a scan"),
      choice("prediction", &Params::prediction,
             {{PredictionKind::odometry, "odometry"},
              {PredictionKind::constant_pose, "constant_pose"},
              {PredictionKind::constant_velocity, "constant_velocity"}},
             "where the next scan is expected; the paper has no odometry: constant_pose"),
      field("step_matcher", &Params::step_matcher,
            "matcher that corrects the prediction by the scan before, and places scans that do not meet the map; none"),
      field("gate_m", &Params::gate_m, above(0), "m", "farthest partner of an end point at first"),
      field("min_share", &Params::min_share, between(0, 1), "",
            "smallest share of a scan's length that must meet the map; below it there is no match"),
      field("search_deg", &Params::search_deg, between(0, 180), "deg",
            "where a scan fits badly, predictions turned so far are tried too, in steps of 10 deg"),
      field("min_length_m", &Params::min_length_m, at_least(0), "m", "shorter lines of a scan are not used"),
      field("min_members", &Params::min_members, between(1, 1e9), "",
            "lines made of fewer scan lines are kept for merging but are not shown in the map")};
}

std::vector<Stroke> Dse::strokes_of(const Observation& observation) const {
  std::vector<Stroke> strokes;
  for (const ScanSegment& line : scan_segments(observation, params_.min_length_m))
    strokes.push_back(
        {.segment = line.segment, .created = step_, .members = 1.0, .points = static_cast<double>(line.points)});
  return strokes;
}

std::vector<Stroke> moved(const Pose2& map_from_sensor, std::vector<Stroke> strokes) {
  for (Stroke& stroke : strokes) stroke.segment = map_from_sensor * stroke.segment;
  return strokes;
}

std::vector<Segment> segments_of(const std::vector<Stroke>& strokes) {
  std::vector<Segment> segments;
  segments.reserve(strokes.size());
  for (const Stroke& stroke : strokes) segments.push_back(stroke.segment);
  return segments;
}

Insertion Dse::outcome(Status status, const Pose2& map_from_sensor, std::string message) {
  prediction_.found(map_from_sensor);
  return {.status = status,
          .world_from_sensor = world_from_map_ * map_from_sensor,
          .lines = static_cast<int>(map_.size()),
          .message = std::move(message)};
}

Insertion Dse::insert(const Observation& observation, const Pose2& guess, Trace& trace) {
  trace.stage(Stage::match);
  const Prediction::Expected expected = prediction_.next(guess, observation.scan.stamp_s);
  const Pose2& predicted = expected.map_from_sensor;
  if (++step_ == 0) world_from_map_ = guess;
  const std::vector<Stroke> scan = strokes_of(observation);
  if (scan.empty()) return outcome(Status::no_match, predicted, "a scan without lines leaves the map as it is");

  InsertionRow row{.scan_lines = static_cast<int>(scan.size())};
  Registration found{.map_from_sensor = predicted};
  if (map_.size() > 0)
    found = from_step([&](const Pose2& from) { return locate(observation, scan, from); },
                      steps_.pose(observation, predicted), predicted, registration_);
  std::vector<Stroke> placed = moved(found.map_from_sensor, scan);
  row.share = found.share;
  row.rms_m = found.rms_m;
  std::string message = aligner_.explained(found);
  const bool fits = found.status != Status::no_match;
  if (fits || novel(placed)) {
    if (!fits) message += "; the map has nothing there yet, so the scan is inserted where it is predicted";
    trace.stage(Stage::merge);
    merge(std::move(placed), row, trace);
  } else {
    message += "; such scans are not inserted";
  }
  if (message.empty()) message = expected.remark;
  row.map_lines = static_cast<int>(map_.size());
  trace.row(row);
  steps_.found(observation, found.map_from_sensor);
  return outcome(found.status, found.map_from_sensor, std::move(message));
}

Registration Dse::locate(const Observation& observation, const std::vector<Stroke>& scan,
                         const Pose2& predicted) const {
  std::vector<Stroke> near;
  for (const std::size_t number : map_.near(segments_of(moved(predicted, scan)), params_.gate_m + kBoxReachM))
    near.push_back(map_.strokes().at(number));
  return aligner_.align(observation, scan, near, predicted);
}

/// True if no line of the map comes near the scan's.
bool Dse::novel(const std::vector<Stroke>& placed) const {
  return map_.near(segments_of(placed), kNovelM).empty();
}

void Dse::merge(std::vector<Stroke> placed, InsertionRow& row, Trace& trace) {
  const std::vector<Segment> segments = segments_of(placed);
  row.polylines = static_cast<int>(generalized_polylines(segments, kPolylineGapM).size());
  const std::vector<Vec2> main = directions(placed, trace);
  const std::vector<std::size_t> near = map_.near(segments, reach_of(merge_));
  row.near_lines = static_cast<int>(near.size());
  std::vector<Stroke> old;
  old.reserve(near.size());
  for (const std::size_t number : near) old.push_back(map_.strokes().at(number));
  // The ends of each map are projected on the other as it was before.
  const std::vector<Stroke> cut_map = with_vertices(old, ends_of(placed), insertion_);
  const std::vector<Stroke> cut_scan = with_vertices(placed, ends_of(old), insertion_);
  const std::vector<Pairing> pairs = pairings(cut_map, cut_scan, main,
                                              {.merge = merge_,
                                               .threshold_m = params_.pairing_threshold_m,
                                               .most_children = params_.most_children,
                                               .placement = params_.placement,
                                               .same_side = params_.same_side});
  row.children = static_cast<int>(pairs.size());
  const SimplificationRule simplification{.merge = merge_,
                                          .threshold_m = params_.simplification_threshold_m,
                                          .placement = params_.placement,
                                          .same_side = params_.same_side};
  replace(near, simplified(paired(cut_map, cut_scan, pairs, step_), main, simplification, step_), trace);
}

/// Unit vectors of the main directions of the recent map; of the scan's own while the map has none.
std::vector<Vec2> Dse::directions(const std::vector<Stroke>& placed, Trace& trace) const {
  const PeakRule rule{.least_share = params_.peak_share, .apart_rad = radians(params_.peak_apart_deg)};
  std::vector<MainDirection> peaks = main_directions(map_.recent_directions(step_ - params_.memory_scans), rule);
  if (peaks.empty()) {
    DirectionHistogram own;
    for (const Stroke& stroke : placed) own.add(stroke.segment);
    peaks = main_directions(own, rule);
  }
  std::vector<Vec2> units;
  for (std::size_t k = 0; k < peaks.size(); ++k) {
    units.emplace_back(std::cos(peaks[k].angle_rad), std::sin(peaks[k].angle_rad));
    trace.row(DirectionRow{.rank = static_cast<int>(k),
                           .angle_rad = direction_mod_pi(peaks[k].angle_rad + world_from_map_.yaw()),
                           .weight_m = peaks[k].weight_m});
  }
  return units;
}

/// Puts `now` in the place of the strokes `old`. A stroke that is in both stays, with its number.
void Dse::replace(const std::vector<std::size_t>& old, const std::vector<Stroke>& now, Trace& trace) {
  std::vector<bool> stays(now.size(), false);
  for (const std::size_t number : old) {
    const Stroke& stroke = map_.strokes().at(number);
    const auto same = std::ranges::find_if(
        now, [&](const Stroke& other) { return other.segment == stroke.segment && other.created == stroke.created; });
    if (same != now.end() && !stays[static_cast<std::size_t>(same - now.begin())]) {
      stays[static_cast<std::size_t>(same - now.begin())] = true;
      continue;
    }
    map_.erase(number);
    trace.row(GoneRow{.line = static_cast<int>(number)});
  }
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (stays[i]) continue;
    const std::size_t number = map_.insert(now[i]);
    const Segment s = world_from_map_ * now[i].segment;
    trace.row(
        BornRow{.line = static_cast<int>(number), .x1_m = s.a.x(), .y1_m = s.a.y(), .x2_m = s.b.x(), .y2_m = s.b.y()});
  }
}

LineMap Dse::map() const {
  LineMap result;
  for (const auto& [number, stroke] : map_.strokes()) {
    const int members = std::max(1, static_cast<int>(std::lround(stroke.members)));
    if (members < params_.min_members) continue;
    result.lines.push_back({.segment = world_from_map_ * stroke.segment,
                            .members = members,
                            .points = static_cast<int>(std::lround(stroke.points))});
  }
  return result;
}

SCANBENCH_REGISTER(
    Mapper, Dse,
    {.name = "dse",
     .summary = "polyline maps by discrete segment evolution: segments of map and scan are paired along main "
                "directions, then merged cheapest first",
     .reference = "Lakaemper, Latecki & Wolter 2005, Geometric robot mapping"});

}  // namespace
}  // namespace scanbench
