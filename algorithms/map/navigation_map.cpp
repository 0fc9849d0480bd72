// navigation_map: the first segmented scan is the map; each later scan corrects its pose by correlation with the map
// and then adds its segments (Siadat, Kaske, Klausmann, Dufaut & Husson 1997, sections 6 and 7).
// docs/algorithms/navigation_map.md.
#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/map/navigation/correlation.hpp"
#include "algorithms/map/navigation/wall.hpp"
#include "algorithms/map/parts/prediction.hpp"
#include "algorithms/map/parts/registration.hpp"
#include "algorithms/map/parts/scan_segments.hpp"
#include "algorithms/map/parts/step_matching.hpp"
#include "core/contracts/map_trace.hpp"
#include "core/geometry/segment_index.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

using namespace mapping;
using namespace mapping::navigation;

constexpr double kNovelWallM = 1.0;   // a scan without a wall of the map so near is in a part that has no map yet
constexpr double kPointCellM = 0.05;  // of the map of points

enum class Correlation { none, segment_segment, segment_point, point_point };

class NavigationMap final : public Mapper {
 public:
  struct Params {
    Correlation correlation = Correlation::segment_point;
    double gate_m = 0.5;
    double min_share = 0.3;
    double search_deg = 0.0;
    double unite_angle_deg = 10.0;
    double unite_offset_m = 0.10;
    double unite_gap_m = 0.20;
    double min_length_m = 0.0;
    PredictionKind prediction = PredictionKind::odometry;
    std::string step_matcher = "none";
    static auto fields() {
      return std::tuple{
          choice("correlation", &Params::correlation,
                 {{Correlation::none, "none"},
                  {Correlation::segment_segment, "segment_segment"},
                  {Correlation::segment_point, "segment_point"},
                  {Correlation::point_point, "point_point"}},
                 "what of a scan is compared with what of the map to correct its pose; none: poses are as predicted"),
          field("gate_m", &Params::gate_m, above(0), "m", "farthest partner at first; halved down to 0.1 m"),
          field("min_share", &Params::min_share, between(0, 1), "",
                "smallest share of a scan that must have partners; below it there is no match"),
          field("search_deg", &Params::search_deg, between(0, 180), "deg",
                "where a scan fits badly, predictions turned so far are tried too, in steps of 10 deg"),
          field("unite_angle_deg", &Params::unite_angle_deg, between(0, 90), "deg",
                "largest angle between segments that become one"),
          field("unite_offset_m", &Params::unite_offset_m, at_least(0), "m",
                "largest distance across between segments that become one"),
          field("unite_gap_m", &Params::unite_gap_m, at_least(0), "m",
                "largest gap along between segments that become one"),
          field("min_length_m", &Params::min_length_m, at_least(0), "m", "shorter lines of a scan are not used"),
          choice("prediction", &Params::prediction,
                 {{PredictionKind::odometry, "odometry"},
                  {PredictionKind::constant_pose, "constant_pose"},
                  {PredictionKind::constant_velocity, "constant_velocity"}},
                 "where the next scan is expected"),
          field("step_matcher", &Params::step_matcher,
                "matcher that corrects the prediction by the scan before, and places scans that do not meet the map; "
                "none")};
    }
  };

  explicit NavigationMap(const Params& p)
      : params_(p),
        registration_{.wide_gate_m = p.gate_m,
                      .narrow_gate_m = std::min(p.gate_m, 0.1),
                      .least_share = p.min_share,
                      .search_rad = radians(p.search_deg)},
        unite_{.angle_rad = radians(p.unite_angle_deg), .offset_m = p.unite_offset_m, .gap_m = p.unite_gap_m},
        prediction_(p.prediction),
        steps_(p.step_matcher, "step_matcher", radians(p.search_deg)),
        points_(kPointCellM) {}

  Insertion insert(const Observation& observation, const Pose2& guess, Trace& trace) override;
  LineMap map() const override;

 private:
  std::vector<Segment> walls_near(const std::vector<Segment>& segments, double reach) const;
  Registration locate(const std::vector<ScanSegment>& scan, const std::vector<Vec2>& points,
                      const Pose2& predicted) const;
  void update(const Observation& observation, const std::vector<ScanSegment>& scan, const Pose2& pose, Trace& trace);
  void add(MapWall wall, Trace& trace);
  void erase(std::size_t number, Trace& trace);
  Insertion outcome(Status status, const Pose2& map_from_sensor, std::string message);

  Params params_;
  RegistrationRule registration_;
  UniteRule unite_;
  Prediction prediction_;
  StepMatching steps_;
  Pose2 world_from_map_;
  bool begun_ = false;
  std::map<std::size_t, MapWall> walls_;
  SegmentIndex index_;
  PointMap points_;  ///< of point_point only
  std::size_t next_ = 0;
};

Insertion NavigationMap::outcome(Status status, const Pose2& map_from_sensor, std::string message) {
  prediction_.found(map_from_sensor);
  return {.status = status,
          .world_from_sensor = world_from_map_ * map_from_sensor,
          .lines = static_cast<int>(walls_.size()),
          .message = std::move(message)};
}

Insertion NavigationMap::insert(const Observation& observation, const Pose2& guess, Trace& trace) {
  trace.stage(Stage::match);
  const Prediction::Expected expected = prediction_.next(guess, observation.scan.stamp_s);
  const Pose2& predicted = expected.map_from_sensor;
  if (!begun_) world_from_map_ = guess;
  begun_ = true;
  const std::vector<ScanSegment> scan = scan_segments(observation, params_.min_length_m);
  if (scan.empty()) return outcome(Status::no_match, predicted, "a scan without lines leaves the map as it is");

  Registration found{.map_from_sensor = predicted, .rank = 3, .share = 1.0};
  if (!walls_.empty() && params_.correlation != Correlation::none)
    found = from_step(
        [&, points = valid_points(observation.scan).points](const Pose2& from) { return locate(scan, points, from); },
        steps_.pose(observation, predicted), predicted, registration_);
  std::string message = explained(found, registration_);
  const bool fits = found.status != Status::no_match;
  if (fits || walls_near(placed_at(predicted, scan), kNovelWallM).empty()) {
    if (!fits) message += "; the map has nothing there yet, so the scan is inserted where it is predicted";
    trace.stage(Stage::merge);
    update(observation, scan, found.map_from_sensor, trace);
  } else {
    message += "; such scans are not inserted";
  }
  if (message.empty()) message = expected.remark;
  trace.row(InsertionRow{.scan_lines = static_cast<int>(scan.size()),
                         .map_lines = static_cast<int>(walls_.size()),
                         .share = found.share,
                         .rms_m = found.rms_m});
  steps_.found(observation, found.map_from_sensor);
  return outcome(found.status, found.map_from_sensor, std::move(message));
}

std::vector<Segment> NavigationMap::walls_near(const std::vector<Segment>& segments, double reach) const {
  std::vector<Segment> near;
  for (const std::size_t number : index_.near(segments, reach)) near.push_back(walls_.at(number).segment);
  return near;
}

Registration NavigationMap::locate(const std::vector<ScanSegment>& scan, const std::vector<Vec2>& points,
                                   const Pose2& predicted) const {
  const std::vector<Segment> walls = walls_near(placed_at(predicted, scan), 2 * params_.gate_m);
  // Lines that are given in place of scans have no points.
  const Correlation by = points.empty() ? Correlation::segment_segment : params_.correlation;
  const SegmentMatchRule rule{};
  const FindPairs find_pairs = [&](const Pose2& pose, double gate) {
    if (by == Correlation::segment_segment) return segment_segment_pairs(scan, walls, pose, gate, rule);
    if (by == Correlation::segment_point) return segment_point_pairs(points, walls, pose, gate);
    return point_point_pairs(points, points_, pose, gate);
  };
  const double all = by == Correlation::segment_segment ? total_length(scan) : static_cast<double>(points.size());
  return register_near(find_pairs, predicted, all, lever_of(scan), registration_);
}

void NavigationMap::update(const Observation& observation, const std::vector<ScanSegment>& scan, const Pose2& pose,
                           Trace& trace) {
  const ScanPoints valid = valid_points(observation.scan);
  std::vector<std::vector<Vec2>> support(observation.lines.lines.size());
  for (std::size_t k = 0; k < valid.size(); ++k) {
    const int label = observation.lines.labels[static_cast<std::size_t>(valid.beams[k])];
    if (label >= 0) support[static_cast<std::size_t>(label)].push_back(pose * valid.points[k]);
  }
  for (const ScanSegment& line : scan)
    add(wall_of(pose * line.segment, support[static_cast<std::size_t>(line.line)]), trace);
  if (params_.correlation != Correlation::point_point) return;
  std::vector<Vec2> placed;
  for (const Vec2& p : valid.points) placed.push_back(pose * p);
  points_.add(placed);
}

void NavigationMap::erase(std::size_t number, Trace& trace) {
  index_.erase(number, walls_.at(number).segment);
  walls_.erase(number);
  trace.row(GoneRow{.line = static_cast<int>(number)});
}

/// Unites the wall with the nearest wall of the map that is the same surface, again and again, for a wall that has
/// grown can touch others.
void NavigationMap::add(MapWall wall, Trace& trace) {
  for (bool grown = true; grown;) {
    grown = false;
    double nearest = kNovelWallM;
    std::size_t partner = 0;
    const std::vector<Segment> place{wall.segment};
    for (const std::size_t number : index_.near(place, params_.unite_gap_m + params_.unite_offset_m)) {
      const Segment& other = walls_.at(number).segment;
      if (!same_surface(wall.segment, other, unite_)) continue;
      const bool longer = other.length() > wall.segment.length();
      const Segment &base = longer ? other : wall.segment, &probe = longer ? wall.segment : other;
      const double apart = std::abs(cross(base.direction(), probe.midpoint() - base.a));
      if (grown && apart >= nearest) continue;
      nearest = apart;
      partner = number;
      grown = true;
    }
    if (!grown) break;
    wall = united(walls_.at(partner), wall);
    erase(partner, trace);
  }
  const std::size_t number = next_++;
  index_.insert(number, wall.segment);
  const Segment s = world_from_map_ * wall.segment;
  trace.row(
      BornRow{.line = static_cast<int>(number), .x1_m = s.a.x(), .y1_m = s.a.y(), .x2_m = s.b.x(), .y2_m = s.b.y()});
  walls_.emplace(number, std::move(wall));
}

LineMap NavigationMap::map() const {
  LineMap result;
  for (const auto& [number, wall] : walls_)
    result.lines.push_back({.segment = world_from_map_ * wall.segment, .members = wall.members, .points = wall.points});
  return result;
}

SCANBENCH_REGISTER(Mapper, NavigationMap,
                   {.name = "navigation_map",
                    .summary = "the first scan is the map; later ones are correlated with it and add their segments",
                    .reference = "Siadat, Kaske, Klausmann, Dufaut & Husson 1997, sections 6 and 7"});

}  // namespace
}  // namespace scanbench
