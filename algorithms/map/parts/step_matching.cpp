// Matches two scans from several headings and judges the matches by their returns.
#include "algorithms/map/parts/step_matching.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "algorithms/match/parts/nearest_return.hpp"
#include "core/error.hpp"
#include "core/names.hpp"
#include "core/registry.hpp"

namespace scanbench::mapping {
namespace {

constexpr double kNearM = 0.1;  // a return so near to one of the last scan is on it
constexpr double kLeastShare = 0.5;
constexpr double kGoodShare = 0.7;
constexpr double kTurnStep = radians(10.0);

/// Share of the current returns that are on those of the reference.
double share_on(const matching::ReturnedPoints& reference, const matching::ReturnedPoints& current,
                const Pose2& reference_from_current) {
  if (current.size() == 0) return 0.0;
  matching::NearestReturn nearest(reference);
  std::size_t on = 0;
  for (const Vec2& point : current.points)
    on += nearest.find(reference_from_current * point, kNearM, matching::Track::kNone) ? 1 : 0;
  return static_cast<double>(on) / static_cast<double>(current.size());
}

}  // namespace

StepMatching::StepMatching(const std::string& matcher, const std::string& parameter, double search_rad)
    : search_rad_(search_rad) {
  if (matcher == "none") return;
  if (Registry<ScanMatcher>::find(matcher) == nullptr) {
    std::vector<std::string> known = Registry<ScanMatcher>::names();
    known.insert(known.begin(), "none");
    throw ParamError(parameter, parameter + " = '" + matcher + "' is unknown; known: " + join(known));
  }
  matcher_ = Registry<ScanMatcher>::make(matcher);
}

std::optional<Pose2> StepMatching::pose(const Observation& scan, const Pose2& predicted) const {
  if (!matcher_ || !last_ || scan.scan.beams() == 0 || last_->ranges.empty()) return std::nullopt;
  const Scan reference = last_->scan();
  const matching::ReturnedPoints seen = matching::returned_points(reference),
                                 now = matching::returned_points(scan.scan);
  const Pose2 step = last_->map_from_sensor.inverse() * predicted;
  Pose2 best;
  double most = 0.0;
  const auto match_from = [&](double turn) {
    Trace silent;
    const Match match = matcher_->match({reference, last_->lines}, scan, step * Pose2(0, 0, turn), silent);
    if (match.status == Status::no_match) return;
    const double share = share_on(seen, now, match.reference_from_current);
    if (share <= most) return;
    most = share;
    best = match.reference_from_current;
  };
  match_from(0.0);
  const int turns = static_cast<int>(search_rad_ / kTurnStep + 1e-9);
  for (int k = 1; k <= turns && most < kGoodShare; ++k)
    for (const double side : {1.0, -1.0}) match_from(side * k * kTurnStep);
  if (most < kLeastShare) return std::nullopt;
  return last_->map_from_sensor * best;
}

void StepMatching::found(const Observation& scan, const Pose2& map_from_sensor) {
  if (!matcher_) return;
  last_ = Last{scan.scan.sensor,
               {scan.scan.ranges.begin(), scan.scan.ranges.end()},
               scan.scan.stamp_s,
               scan.lines,
               map_from_sensor};
}

}  // namespace scanbench::mapping
