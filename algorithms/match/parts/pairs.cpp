// Nearest pairs, trimming, and the covariance of a pose that they give.
#include "algorithms/match/parts/pairs.hpp"

#include <algorithm>
#include <cmath>

namespace scanbench::matching {
namespace {

// A wall seen along has a normal that is too uncertain for the small noise across it.
constexpr double kLeastCosine = 0.15;

double variance_across(const ReturnedPoints& scan, std::size_t k, const Vec2& normal_in_scan) {
  const double sigma = std::max(scan.sigmas[k], kLeastSigmaM);
  const double cosine = std::max(std::fabs(normal_in_scan.dot(scan.direction(k))), kLeastCosine);
  return sigma * sigma * cosine * cosine;
}

}  // namespace

std::vector<Pair> nearest_pairs(const ReturnedPoints& current, const Pose2& reference_from_current, double gate_m,
                                NearestReturn& reference, std::vector<Track>& tracks, std::size_t every) {
  std::vector<Pair> pairs;
  pairs.reserve(current.size() / every + 1);
  std::size_t last = Track::kNone;
  for (std::size_t k = 0; k < current.size(); k += every) {
    const Vec2 p = reference_from_current * current.points[k];
    // Neighbours have neighbours as partners: a good place to begin a first search.
    if (tracks[k].partner == Track::kNone) tracks[k].partner = last;
    const auto nearest = reference.follow(p, gate_m, tracks[k]);
    if (!nearest) continue;
    last = *nearest;
    pairs.push_back({k, *nearest, p, 0.0});
  }
  return pairs;
}

void keep_aligned(std::vector<Pair>& pairs, const std::vector<LocalLine>& lines,
                  const std::vector<LocalLine>& current_lines, const Pose2& reference_from_current) {
  constexpr double kAligned = 0.94;  // cosine of 20 degrees
  std::erase_if(pairs, [&](const Pair& pair) {
    const LocalLine &there = lines[pair.reference], &here = current_lines[pair.current];
    return !there.known() || std::fabs(reference_from_current.rotate(here.normal).dot(there.normal)) < kAligned;
  });
}

namespace {

/// |residual| that a share of the pairs does not exceed.
double quantile(const std::vector<Pair>& pairs, double share) {
  std::vector<double> sizes;
  sizes.reserve(pairs.size());
  for (const Pair& pair : pairs) sizes.push_back(std::fabs(pair.residual));
  const auto at = static_cast<std::size_t>(share * static_cast<double>(sizes.size() - 1));
  std::ranges::nth_element(sizes, sizes.begin() + static_cast<std::ptrdiff_t>(at));
  return sizes[at];
}

void keep_up_to(std::vector<Pair>& pairs, double largest) {
  std::erase_if(pairs, [&](const Pair& pair) { return std::fabs(pair.residual) > largest; });
}

}  // namespace

void keep_nearest(std::vector<Pair>& pairs, double share) {
  if (!pairs.empty()) keep_up_to(pairs, quantile(pairs, share));
}

void trim(std::vector<Pair>& pairs, double times) {
  if (!pairs.empty()) keep_up_to(pairs, times * quantile(pairs, 0.5));
}

PairInformation pair_information(const std::vector<Pair>& pairs, const ReturnedPoints& current,
                                 const std::vector<LocalLine>& lines, const Pose2& reference_from_current) {
  PairInformation result;
  const Pose2 current_from_reference = reference_from_current.inverse();
  for (const Pair& pair : pairs) {
    const LocalLine& line = lines[pair.reference];
    if (!line.known()) continue;
    const double variance = variance_across(current, pair.current, current_from_reference.rotate(line.normal));
    const double residual = -line.distance(pair.point);
    result.equations.add(line.normal, pair.point - reference_from_current.translation(), residual, 1.0 / variance,
                         line.angle_variance);
    result.misfit += residual * residual / variance;
    ++result.count;
  }
  return result;
}

Match no_match(const Pose2& guess) {
  return {Status::no_match, guess, Eigen::Matrix3d::Zero()};
}

Match conclusion(const PairInformation& information, const Pose2& reference_from_current, const Pose2& guess,
                 double lever_m, bool settled) {
  Match match{settled ? Status::converged : Status::max_iterations, reference_from_current, Eigen::Matrix3d::Zero()};
  const Determined determined(information.equations, lever_m, kLeastRatioOfPoints);
  if (determined.rank() < 3) {
    match.status = Status::degenerate;
    const Motion correction = motion_between(guess, reference_from_current);
    match.reference_from_current = moved(guess, determined.project(correction));
  }
  // Each scan's noise moves the pose by the inverse of the information: the reference is as noisy as the current scan.
  // Where residuals are larger than the noise, something else moves it too.
  const double excess = information.count > 3 ? information.misfit / (information.count - 3) : 1.0;
  match.covariance = determined.covariance(2.0 * std::max(excess, 1.0));
  return match;
}

}  // namespace scanbench::matching
