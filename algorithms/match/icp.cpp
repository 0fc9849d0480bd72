// Point-to-point ICP as the papers use it: Lakaemper, Latecki & Wolter 2005, section 2, "Alignment", after Besl & McKay
// 1992. docs/algorithms/scan_matching.md, section 1.
//
// Departures. Trimmed: the tenth of the pairs that is farthest apart is left out. Far from the pose only some
// 150 returns are paired. Iterations end when the mean squared distance changes by less than 1e-8 m^2 or 0.05 %.
// Status and covariance come from the lines through neighbouring returns: by distances between points every motion
// seems known, even along a corridor.
#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "algorithms/match/parts/extrapolation.hpp"
#include "algorithms/match/parts/pairs.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench::matching {
namespace {

/// One step. The shift is along the reference's axes.
struct IcpIterationRow {
  static constexpr std::string_view kName = "icp_iteration";
  int pairs = 0;
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;
  double squares_m2 = 0.0;  ///< sum of squared distances before the step
  static constexpr auto columns() {
    using R = IcpIterationRow;
    return std::tuple{column("pairs", &R::pairs), column("x_m", &R::x_m), column("y_m", &R::y_m),
                      column("yaw_rad", &R::yaw_rad), column("squares_m2", &R::squares_m2)};
  }
};

/// The motion of the plane that brings the current returns nearest to their partners: centroids, then
/// theta = atan2(sum of cross products, sum of dot products).
Pose2 rigid_fit(const std::vector<Pair>& pairs, const ReturnedPoints& reference) {
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();
  for (const Pair& pair : pairs) {
    from += pair.point;
    to += reference.points[pair.reference];
  }
  const auto n = static_cast<double>(pairs.size());
  from /= n;
  to /= n;
  double sine = 0.0, cosine = 0.0;
  for (const Pair& pair : pairs) {
    const Vec2 a = pair.point - from, b = reference.points[pair.reference] - to;
    sine += cross(a, b);
    cosine += a.dot(b);
  }
  const Pose2 turn(0, 0, std::atan2(sine, cosine));
  return Pose2::from_unit(to - turn.rotate(from), {turn.cos(), turn.sin()});
}

/// Covariance of the pose where the iterations end, from the pattern of the beams alone. Two scans of a wall have no
/// points in common, and iterations end where partners no longer change. As points move, the first partners change at
/// half of the distance between neighbouring returns and the last at the whole distance. The pose is therefore found up
/// to a motion that moves the points by three quarters of their spacing, root mean square over the points and the three
/// motions: C^-1 = 3/n sum J' J / (3/4 spacing)^2.
Eigen::Matrix3d pattern_covariance(const std::vector<Pair>& pairs, const ReturnedPoints& reference,
                                   const Vec2& sensor) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (const Pair& pair : pairs) {
    const std::size_t k = pair.reference;
    const std::size_t before = k > 0 ? k - 1 : k, behind = std::min(k + 1, reference.size() - 1);
    if (before == behind) continue;
    const double spacing =
        (reference.points[behind] - reference.points[before]).norm() / static_cast<double>(behind - before);
    const double reach = 0.75 * spacing;
    const Vec2 turn = perpendicular(pair.point - sensor);
    Eigen::Matrix<double, 2, 3> jacobian;
    jacobian << 1.0, 0.0, turn.x(), 0.0, 1.0, turn.y();
    information += jacobian.transpose() * jacobian / (reach * reach + 1e-12);
  }
  const double determinant = information.determinant();
  if (!(determinant > 0)) return Eigen::Matrix3d::Zero();
  return information.inverse() * (static_cast<double>(pairs.size()) / 3.0);
}

class Icp final : public ScanMatcher {
 public:
  struct Params {
    double gate_m = 0.5;
    double keep = 0.9;
    double guess_sigma_m = 0.1;
    double guess_sigma_deg = 3.0;
    double min_overlap = 0.3;
    int max_iterations = 50;
    static auto fields() {
      return std::tuple{
          field("gate_m", &Params::gate_m, between(1e-6, 1e6), "m", "farthest partner of a return"),
          field("keep", &Params::keep, between(0, 1), "", "share of the pairs, the nearest ones, that counts"),
          field("guess_sigma_m", &Params::guess_sigma_m, above(0), "m",
                "standard deviation of the guess per axis; a result outside of 95 % of it is held against it"),
          field("guess_sigma_deg", &Params::guess_sigma_deg, above(0), "deg",
                "standard deviation of the guess's heading"),
          field("min_overlap", &Params::min_overlap, between(0, 1), "",
                "smallest share of returns with a partner; below it there is no match"),
          field("max_iterations", &Params::max_iterations, between(1, 1e6), "", "iterations at most")};
    }
  };
  explicit Icp(const Params& p) : params_(p) {}

  Match match(const Observation& reference, const Observation& current, const Pose2& guess,
              Trace& trace) const override {
    trace.stage(Stage::pre);
    const ReturnedPoints seen = returned_points(reference.scan), now = returned_points(current.scan);
    const std::vector<LocalLine> lines = local_lines(seen);
    trace.stage(Stage::iterate);
    NearestReturn nearest(seen);
    std::vector<Track> tracks(now.size());
    Pose2 pose = guess;
    std::vector<Pair> pairs;
    // Far from the pose a part of the returns says as well where to go.
    std::size_t every = std::max<std::size_t>(now.size() / kFewReturns, 1);
    const double lever = lever_of(now);
    Extrapolation extrapolation;
    bool settled = false;
    double last_mean = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < params_.max_iterations && !settled; ++iteration) {
      pairs = nearest_pairs(now, pose, params_.gate_m, nearest, tracks, every);
      const double overlap = static_cast<double>(pairs.size() * every) / static_cast<double>(now.size());
      if (pairs.empty() || !(overlap >= params_.min_overlap)) return no_match(guess);
      double squares = 0.0;
      for (Pair& pair : pairs) pair.residual = (pair.point - seen.points[pair.reference]).squaredNorm();
      keep_nearest(pairs, params_.keep);
      for (const Pair& pair : pairs) squares += pair.residual;
      const double mean = squares / static_cast<double>(pairs.size());
      Motion step = motion_between(pose, rigid_fit(pairs, seen) * pose);
      step *= extrapolation.factor(step.cwiseProduct(Motion(1.0, 1.0, lever)), mean);
      pose = moved(pose, step);
      const double change = std::fabs(mean - last_mean);
      last_mean = mean;
      const double still = std::max(kStillM2, (every > 1 ? kNearShare : kStillShare) * mean);
      settled = every == 1 && change < still;
      if (change < still) every = 1;
      trace.row(IcpIterationRow{static_cast<int>(pairs.size()), step.x(), step.y(), step.z(), squares});
    }
    for (Pair& pair : pairs) pair.point = pose * now.points[pair.current];
    set_noise(pairs, now, lines, pose);
    Match result =
        conclusion(pair_information(pairs, lines, pose), pose,
                   Guess(guess, params_.guess_sigma_m, radians(params_.guess_sigma_deg)), true, lever, settled);
    result.covariance += pattern_covariance(pairs, seen, pose.translation());
    return result;
  }

 private:
  static constexpr double kStillM2 = 1e-8;         // change of the mean squared distance
  static constexpr double kStillShare = 5e-4;      // the same as a share of it
  static constexpr double kNearShare = 0.01;       // the share until which few returns do
  static constexpr std::size_t kFewReturns = 150;  // so many
  Params params_;
};

SCANBENCH_REGISTER(ScanMatcher, Icp,
                   {.name = "icp",
                    .summary = "point-to-point ICP: closed-form rigid fits to nearest returns",
                    .reference = "Besl & McKay 1992, PAMI 14(2); Lakaemper, Latecki & Wolter 2005, section 2"});

}  // namespace
}  // namespace scanbench::matching
