// Chooses the method and judges its result by the share of the scan that meets the map.
#include "algorithms/map/dse/alignment.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "algorithms/map/parts/map_view.hpp"
#include "core/error.hpp"
#include "core/median.hpp"
#include "core/names.hpp"
#include "core/registry.hpp"

namespace scanbench::mapping::dse {
namespace {

constexpr double kShortestLeverM = 1e-3;

/// Typical distance of the scan's ends from the sensor.
double lever_of(std::span<const Stroke> scan) {
  std::vector<double> distances;
  for (const Vec2& end : ends_of(scan)) distances.push_back(end.norm());
  return distances.empty() ? 1.0 : std::max(median(distances), kShortestLeverM);
}

double length_of(std::span<const Stroke> strokes) {
  double sum = 0.0;
  for (const Stroke& stroke : strokes) sum += stroke.segment.length();
  return sum;
}

}  // namespace

MapAligner::MapAligner(std::string method, const CorrespondenceRule& correspondence,
                       const RegistrationRule& registration)
    : method_(std::move(method)), correspondence_(correspondence), registration_(registration) {
  if (method_ == "end_points" || method_ == "none") return;
  if (Registry<ScanMatcher>::find(method_) == nullptr) {
    std::vector<std::string> known = Registry<ScanMatcher>::names();
    known.insert(known.begin(), {"end_points", "none"});
    throw ParamError("alignment", "alignment = '" + method_ + "' is unknown; known: " + join(known));
  }
  matcher_ = Registry<ScanMatcher>::make(method_);
}

Registration MapAligner::align(const Observation& observation, std::span<const Stroke> scan,
                               std::span<const Stroke> near, const Pose2& predicted) const {
  if (method_ == "none") return {.map_from_sensor = predicted, .rank = 3, .share = 1.0};
  if (matcher_ != nullptr && observation.scan.beams() > 0) return by_matcher(observation, near, predicted);
  const FindPairs find_pairs = [&](const Pose2& pose, double gate) {
    return end_point_pairs(scan, near, pose, gate, correspondence_);
  };
  return register_on_lines(find_pairs, predicted, length_of(scan), lever_of(scan), registration_);
}

Registration MapAligner::by_matcher(const Observation& observation, std::span<const Stroke> near,
                                    const Pose2& predicted) const {
  std::vector<Segment> walls;
  for (const Stroke& stroke : near) walls.push_back(stroke.segment);
  const MapView view = view_of(walls, predicted, observation.scan.sensor);
  Trace silent;
  const Match match = matcher_->match({view.scan(observation.scan), view.lines}, observation, {}, silent);
  Registration result{.status = match.status, .map_from_sensor = predicted, .rank = 3, .share = 1.0};
  if (match.status == Status::no_match) {
    result.rank = 0;
    result.share = 0.0;
  } else {
    result.map_from_sensor = predicted * match.reference_from_current;
  }
  return result;
}

std::string MapAligner::explained(const Registration& registration) const {
  if (registration.status == Status::converged && !registration.by_step) return "";
  if (matcher_ != nullptr && !registration.by_step)
    return method_ + " says " + std::string(to_string(registration.status));
  return mapping::explained(registration, registration_);
}

}  // namespace scanbench::mapping::dse
