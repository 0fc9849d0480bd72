// The equations of single returns.
#include "algorithms/match/optimal/lone_returns.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace scanbench::matching {
namespace {

constexpr double kReturnGate = 9.0;          // three standard deviations
constexpr double kStrayReturns = 0.2;        // share of returns that are not of the line that they are on ...
constexpr double kStrayReturnDensity = 1.0;  // ... whose distances from it spread over a metre
constexpr double kLeastReturnCosine = 0.15;  // of a beam with the normal
constexpr double kAllowedTurn = 0.01;  // rad^2; a line with a larger variance of its angle is known at its middle only

/// A return and a line in the reference frame; the belief about the pose moves one of the two.
struct Sighted {
  Vec2 point;
  double variance;  ///< across the line, of return and line together
  double distance;  ///< of the point beyond the line
};

std::optional<Sighted> sighted(const LoneReturn& reading, const MeasuredLine& line, const Vec2& sensor_of_point) {
  const Vec2 ray = reading.point - sensor_of_point;
  const double cosine = line.normal.dot(ray) / ray.norm();
  const double along = perpendicular(line.normal).dot(reading.point - line.middle);
  if (!(cosine > kLeastReturnCosine) || std::fabs(along) > line.half_length || line.covariance(1, 1) > kAllowedTurn)
    return std::nullopt;
  const Eigen::Vector2d turn(1.0, -along);
  const double across = reading.sigma * cosine;
  return Sighted{reading.point, across * across + turn.dot(line.covariance * turn),
                 line.normal.dot(reading.point - line.middle)};
}

/// `sign`: 1 where the motion moves the point, -1 where it moves the line.
void add_best(const LoneReturn& reading, std::span<const MeasuredLine> lines, const Vec2& sensor_of_point, double sign,
              const PoseBelief& belief, const PoseDoubt& doubt, WallEquations& sum) {
  const Vec2 sensor = belief.reference_from_current.translation();
  double least = kReturnGate;
  std::optional<Sighted> best;
  const MeasuredLine* on = nullptr;
  for (const MeasuredLine& line : lines) {
    const auto seen = sighted(reading, line, sensor_of_point);
    if (!seen) continue;
    const Motion g = gradient(line.normal, seen->point - sensor);
    const double squared = seen->distance * seen->distance / (seen->variance + g.dot(belief.covariance * g));
    if (squared >= least) continue;
    least = squared;
    best = seen;
    on = &line;
  }
  if (!best) return;
  const Motion g = gradient(on->normal, best->point - sensor);
  const double allowed = best->variance + g.dot(doubt.covariance * g);
  const double variance = doubt.of_each_wall ? allowed : best->variance;
  const double density = std::exp(-0.5 * best->distance * best->distance / allowed) / std::sqrt(kTwoPi * allowed);
  const double weight =
      (1.0 - kStrayReturns) * density / ((1.0 - kStrayReturns) * density + kStrayReturns * kStrayReturnDensity);
  sum.equations.add(on->normal, best->point - sensor, -sign * best->distance, weight / variance, on->covariance(1, 1));
  sum.misfit += weight * best->distance * best->distance / variance;
  sum.coordinates += weight;
}

std::vector<MeasuredLine> unpaired(std::span<const MeasuredLine> lines, std::span<const WallPair> walls,
                                   std::vector<std::size_t> WallPair::*members) {
  std::vector<MeasuredLine> result;
  for (std::size_t k = 0; k < lines.size(); ++k)
    if (std::ranges::none_of(walls, [&](const WallPair& w) { return std::ranges::count(w.*members, k) > 0; }))
      result.push_back(lines[k]);
  return result;
}

}  // namespace

Remainder remainder(std::span<const WallPair> walls, const ScanMeasurements& reference,
                    const ScanMeasurements& current) {
  return {unpaired(reference.lines, walls, &WallPair::reference), unpaired(current.lines, walls, &WallPair::current),
          reference.returns, current.returns};
}

void add_lone_returns(const Remainder& rest, const PoseBelief& belief, const PoseDoubt& doubt, WallEquations& sum) {
  const Pose2& pose = belief.reference_from_current;
  for (const LoneReturn& reading : rest.current_returns)
    add_best({pose * reading.point, reading.sigma}, rest.reference_lines, pose.translation(), 1.0, belief, doubt, sum);
  if (rest.reference_returns.empty()) return;
  std::vector<MeasuredLine> placed;
  for (const MeasuredLine& line : rest.current_lines) placed.push_back(moved(pose, line));
  for (const LoneReturn& reading : rest.reference_returns)
    add_best(reading, placed, Vec2::Zero(), -1.0, belief, doubt, sum);
}

}  // namespace scanbench::matching
