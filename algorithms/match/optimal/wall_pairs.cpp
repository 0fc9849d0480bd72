// Pairs walls by normalised difference; the Fisher information of paired walls.
#include "algorithms/match/optimal/wall_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include <Eigen/LU>

namespace scanbench::matching {
namespace {

constexpr double kWallGate = 13.8;         // 99.9 % of chi-square with 2 degrees of freedom
constexpr double kLeastWallCosine = 0.8;   // lines that differ by more are not measurements of one angle
constexpr double kLeastOverlap = 0.25;     // of the shorter line
constexpr double kAlike = 0.5;             // share of walls whose lines are moved alike by what they doubt
constexpr double kStrayWalls = 0.02;       // share of pairs that are not one wall ...
constexpr double kStrayWallDensity = 2.0;  // ... and whose differences spread over a metre and half a radian

/// Turning a line moves it by -t d alpha at the point t along it.
Eigen::Matrix2d shift_to(const Vec2& point, const MeasuredLine& line) {
  Eigen::Matrix2d shift;
  shift << 1.0, -perpendicular(line.normal).dot(point - line.middle), 0.0, 1.0;
  return shift;
}

/// A line at a point near it, against a normal.
WallPlace place_at(const MeasuredLine& line, const Vec2& point, const Vec2& normal) {
  const double cosine = line.normal.dot(normal);
  const Eigen::Matrix2d shift = shift_to(point, line);
  return {{line.normal.dot(line.middle - point) / cosine, std::atan2(cross(normal, line.normal), cosine)},
          shift * line.covariance * shift.transpose()};
}

/// The same of its plain line.
WallPlace plain_place_at(const MeasuredLine& line, const Vec2& point, const Vec2& normal) {
  const Eigen::Matrix2d shift = shift_to(point, line);
  return {place_at(line, point, normal).place + shift * line.plain_place,
          shift * line.plain_covariance * shift.transpose()};
}

/// Mean of two independent places of one wall.
WallPlace mean_place(const WallPlace& a, const WallPlace& b) {
  const Eigen::Matrix2d gain = a.covariance * (a.covariance + b.covariance).inverse();
  return {a.place + gain * (b.place - a.place), a.covariance - gain * a.covariance};
}

double normalised(const Eigen::Vector2d& difference, const Eigen::Matrix2d& covariance) {
  return difference.dot(covariance.inverse() * difference);
}

/// Length that two lines have in common, along the first.
double overlap(const MeasuredLine& a, const MeasuredLine& b) {
  const double between = std::fabs(perpendicular(a.normal).dot(b.middle - a.middle));
  return std::min({a.half_length + b.half_length - between, 2 * a.half_length, 2 * b.half_length});
}

Eigen::Matrix<double, 2, 3> jacobian_at(const Vec2& point, const Vec2& normal, const Vec2& sensor) {
  Eigen::Matrix<double, 2, 3> jacobian;
  jacobian << gradient(normal, point - sensor).transpose(), 0.0, 0.0, 1.0;
  return jacobian;
}

/// Normalised difference of two lines in one frame; infinite for lines that cannot be one wall.
double difference(const MeasuredLine& reference, const MeasuredLine& current, const PoseBelief& belief) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  if (!(reference.normal.dot(current.normal) > kLeastWallCosine)) return kNever;
  if (!(overlap(current, reference) > kLeastOverlap * 2.0 * std::min(reference.half_length, current.half_length)))
    return kNever;
  const WallPlace there = place_at(reference, current.middle, current.normal);
  const Eigen::Matrix<double, 2, 3> jacobian =
      jacobian_at(current.middle, current.normal, belief.reference_from_current.translation());
  const Eigen::Matrix2d covariance =
      there.covariance + current.covariance + jacobian * belief.covariance * jacobian.transpose();
  return normalised(there.place, covariance);
}

/// True if two lines of one scan can be parts of one wall, by their own covariances.
bool agree(const MeasuredLine& a, const MeasuredLine& b) {
  if (!(a.normal.dot(b.normal) > kLeastWallCosine)) return false;
  const WallPlace other = place_at(b, a.middle, a.normal);
  return normalised(other.place, other.covariance + a.covariance) < kWallGate;
}

std::optional<std::size_t> least(std::span<const double> values) {
  const auto at = std::ranges::min_element(values);
  if (at == values.end() || !(*at < kWallGate)) return std::nullopt;
  return static_cast<std::size_t>(at - values.begin());
}

using PlaceAt = WallPlace (*)(const MeasuredLine&, const Vec2& point, const Vec2& normal);

/// Place of a wall by all its lines of one scan.
WallPlace place_of(std::span<const std::size_t> members, std::span<const MeasuredLine> lines, const Vec2& point,
                   const Vec2& normal, PlaceAt place_at) {
  WallPlace place = place_at(lines[members.front()], point, normal);
  for (const std::size_t k : members.subspan(1)) place = mean_place(place, place_at(lines[k], point, normal));
  return place;
}

/// The two places of a wall, for one of the ways in which its lines can be one wall.
struct Difference {
  Eigen::Vector2d off = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  double angle_variance = 0.0;  ///< of the current scan
};

Difference difference_of(const WallPlace& there, const WallPlace& here) {
  return {there.place - here.place, there.covariance + here.covariance, here.covariance(1, 1)};
}

}  // namespace

std::vector<WallPair> pair_walls(std::span<const MeasuredLine> reference, std::span<const MeasuredLine> current,
                                 const PoseBelief& belief) {
  std::vector<MeasuredLine> placed;
  for (const MeasuredLine& line : current) placed.push_back(moved(belief.reference_from_current, line));
  std::vector<WallPair> walls;
  std::vector<int> wall_of(reference.size(), -1);
  std::vector<double> differences(reference.size() * placed.size());
  for (std::size_t j = 0; j < placed.size(); ++j)
    for (std::size_t i = 0; i < reference.size(); ++i)
      differences[j * reference.size() + i] = difference(reference[i], placed[j], belief);

  for (std::size_t j = 0; j < placed.size(); ++j) {
    const auto i = least(std::span(differences).subspan(j * reference.size(), reference.size()));
    if (!i) continue;
    if (wall_of[*i] < 0) {
      wall_of[*i] = static_cast<int>(walls.size());
      walls.push_back({{*i}, {j}});
    } else {
      std::vector<std::size_t>& members = walls[static_cast<std::size_t>(wall_of[*i])].current;
      if (std::ranges::all_of(members, [&](std::size_t k) { return agree(placed[k], placed[j]); }))
        members.push_back(j);
    }
  }
  // A line of the reference that nobody took may be a further part of a wall that the current scan sees in one piece.
  for (std::size_t i = 0; i < reference.size(); ++i) {
    if (wall_of[i] >= 0) continue;
    std::vector<double> of_line;
    for (std::size_t j = 0; j < placed.size(); ++j) of_line.push_back(differences[j * reference.size() + i]);
    const auto j = least(of_line);
    if (!j) continue;
    const auto wall = std::ranges::find_if(walls, [&](const WallPair& w) { return std::ranges::count(w.current, *j); });
    if (wall == walls.end()) continue;
    const bool one =
        std::ranges::all_of(wall->reference, [&](std::size_t k) { return agree(reference[k], reference[i]); });
    if (one) wall->reference.push_back(i);
  }
  return walls;
}

WallEquations wall_equations(std::span<const WallPair> walls, std::span<const MeasuredLine> reference,
                             std::span<const MeasuredLine> current, const Pose2& reference_from_current,
                             const PoseDoubt& doubt) {
  constexpr std::array<PlaceAt, 2> kWays{plain_place_at, place_at};
  constexpr std::array<double, 2> kShares{kAlike, 1.0 - kAlike};
  WallEquations result;
  std::vector<MeasuredLine> placed;
  for (const MeasuredLine& line : current) placed.push_back(moved(reference_from_current, line));
  const Vec2& sensor = reference_from_current.translation();
  for (const WallPair& wall : walls) {
    const Vec2& point = placed[wall.current.front()].middle;
    const Vec2& normal = placed[wall.current.front()].normal;
    const Eigen::Matrix<double, 2, 3> jacobian = jacobian_at(point, normal, sensor);
    const Motion turned = gradient(perpendicular(normal), point - sensor);
    const Eigen::Matrix2d by_doubt = jacobian * doubt.covariance * jacobian.transpose();
    std::array<Difference, 2> ways;
    std::array<double, 2> densities{};
    for (std::size_t k = 0; k < 2; ++k) {
      ways[k] = difference_of(place_of(wall.reference, reference, point, normal, kWays[k]),
                              place_of(wall.current, placed, point, normal, kWays[k]));
      const Eigen::Matrix2d allowed = ways[k].covariance + by_doubt;
      densities[k] =
          kShares[k] * std::exp(-0.5 * normalised(ways[k].off, allowed)) / (kTwoPi * std::sqrt(allowed.determinant()));
      if (doubt.of_each_wall) ways[k].covariance = allowed;
    }
    const double one_wall = (1.0 - kStrayWalls) * (densities[0] + densities[1]),
                 stray = kStrayWalls * kStrayWallDensity;
    for (std::size_t k = 0; k < 2; ++k) {
      const double weight = (1.0 - kStrayWalls) * densities[k] / (one_wall + stray);
      const Eigen::Matrix2d information = weight * ways[k].covariance.inverse();
      result.equations.matrix += jacobian.transpose() * information * jacobian;
      result.equations.rhs += jacobian.transpose() * (information * ways[k].off);
      result.equations.by_chance +=
          (information(0, 0) * std::min(ways[k].angle_variance, 1.0)) * turned * turned.transpose();
      result.misfit += ways[k].off.dot(information * ways[k].off);
    }
    result.walls += one_wall / (one_wall + stray);
    result.coordinates += 2.0 * one_wall / (one_wall + stray);
    result.evidence += std::log1p(one_wall / stray);
  }
  return result;
}

}  // namespace scanbench::matching
