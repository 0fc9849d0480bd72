// Nearest pairs, trimming, and the covariance of a pose that they give.
#include "algorithms/match/parts/pairs.hpp"

#include <algorithm>
#include <cmath>

namespace scanbench::matching {
namespace {

// A wall seen along has a normal that is too uncertain for the small noise across it.
constexpr double kLeastPairCosine = 0.15;

// How many times better than the guess pairs must know a motion if it contradicts the guess. Of the pairs of scans of
// ACES that contradict it, those that are right know every motion to 1 cm, the wrong ones some motion to 3 to 12 cm.
constexpr double kMuchBetter = 5.0;

double sigma_across(const ReturnedPoints& scan, std::size_t k, const Vec2& normal_in_scan) {
  const double cosine = std::max(std::fabs(normal_in_scan.dot(scan.direction(k))), kLeastPairCosine);
  return std::max(scan.sigmas[k], kLeastSigmaM) * cosine;
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
    pairs.push_back({k, *nearest, p});
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

/// The element that would be at place `at` in ascending order. A sample gives a bound that about `at` elements do not
/// exceed. One pass without branches divides the elements there, and only one part is searched.
double element_at(std::vector<double>& values, std::size_t at) {
  constexpr std::size_t kStride = 8;
  const std::size_t n = values.size();
  std::vector<double> side;
  side.reserve(n / kStride + 1);
  for (std::size_t k = kStride / 2; k < n; k += kStride) side.push_back(values[k]);
  const auto select = [](std::vector<double>& from, std::size_t place) {
    std::ranges::nth_element(from, from.begin() + static_cast<std::ptrdiff_t>(place));
    return from[place];
  };
  if (side.size() < kStride) return select(values, at);
  const std::size_t of_sample = at * side.size() / n;
  // A little below the place, so that it is usually in the smaller part above.
  const double bound = select(side, of_sample - std::min(of_sample, side.size() / 16 + 1));
  side.resize(n);
  std::size_t above = 0;
  for (const double value : values) {
    side[above] = value;
    above += value > bound ? 1 : 0;
  }
  const std::size_t below = n - above;
  if (at < below) return select(values, at);
  side.resize(above);
  return select(side, at - below);
}

/// Keeps the pairs whose size is at most `times` the size that a share of them does not exceed.
template <class Size>
void keep_up_to(std::vector<Pair>& pairs, double share, double times, const Size& size_of) {
  if (pairs.empty()) return;
  std::vector<double> sizes;
  sizes.reserve(pairs.size());
  for (const Pair& pair : pairs) sizes.push_back(size_of(pair));
  const double most =
      times * element_at(sizes, static_cast<std::size_t>(share * static_cast<double>(sizes.size() - 1)));
  std::erase_if(pairs, [&](const Pair& pair) { return size_of(pair) > most; });
}

}  // namespace

void keep_nearest(std::vector<Pair>& pairs, double share) {
  keep_up_to(pairs, share, 1.0, [](const Pair& pair) { return std::fabs(pair.residual); });
}

void trim(std::vector<Pair>& pairs, double times, bool by_noise) {
  keep_up_to(pairs, 0.5, times, [by_noise](const Pair& pair) {
    return by_noise ? std::fabs(pair.residual) / pair.sigma_m : std::fabs(pair.residual);
  });
}

void set_noise(std::vector<Pair>& pairs, const ReturnedPoints& current, const std::vector<LocalLine>& lines,
               const Pose2& reference_from_current) {
  const Pose2 current_from_reference = reference_from_current.inverse();
  for (Pair& pair : pairs)
    pair.sigma_m = sigma_across(current, pair.current, current_from_reference.rotate(lines[pair.reference].normal));
}

PairInformation pair_information(const std::vector<Pair>& pairs, const std::vector<LocalLine>& lines,
                                 const Pose2& reference_from_current) {
  PairInformation result;
  for (const Pair& pair : pairs) {
    const LocalLine& line = lines[pair.reference];
    if (!line.known()) continue;
    const double variance = pair.sigma_m * pair.sigma_m;
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

Match conclusion(const PairInformation& information, const Pose2& reference_from_current, const Guess& guess, bool held,
                 double lever_m, bool settled) {
  // Each scan's noise moves the pose by the inverse of the information: the reference is as noisy as the current scan.
  // Where residuals are larger than the noise, something else moves it too.
  const double excess = information.count > 3 ? information.misfit / (information.count - 3) : 1.0;
  const double scale = 2.0 * std::max(excess, 1.0);
  const auto pose_by = [&](const Determined& known) {
    const Motion correction = motion_between(guess.pose(), reference_from_current);
    return known.rank() < 3 ? moved(guess.pose(), known.project(correction)) : reference_from_current;
  };
  Determined determined(information.equations, lever_m, kLeastRatioOfPoints);
  const bool doubtful = held && !guess.unexplained_shift(pose_by(determined)).isZero(0.0);
  if (doubtful) {
    PoseEquations equations = information.equations;
    equations.by_chance += kMuchBetter * kMuchBetter * scale / kLeastRatioOfPoints * guess.information();
    determined = Determined(equations, lever_m, kLeastRatioOfPoints);
  }
  const Status of_iterations = settled ? Status::converged : Status::max_iterations;
  Match match{determined.rank() < 3 ? Status::degenerate : of_iterations, pose_by(determined),
              determined.covariance(scale)};
  if (doubtful) {
    const Vec2 rest = guess.unexplained_shift(match.reference_from_current);
    match.covariance.topLeftCorner<2, 2>() += rest * rest.transpose();
  }
  return match;
}

}  // namespace scanbench::matching
