// Iterations of point-to-line registration (Censi 2008, section III, with Gauss-Newton steps in place of the closed
// form: both minimise the same sum, and the step shows which motions are open).
#include "algorithms/match/parts/point_line_registration.hpp"

#include <cmath>

namespace scanbench::matching {
namespace {

/// One step. The shift is along the reference's axes.
struct PointLineIterationRow {
  static constexpr std::string_view kName = "point_line_iteration";
  int pairs = 0;
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;
  double misfit = 0.0;  ///< sum of squared residuals before the step, in standard deviations
  static constexpr auto columns() {
    using R = PointLineIterationRow;
    return std::tuple{column("pairs", &R::pairs), column("x_m", &R::x_m), column("y_m", &R::y_m),
                      column("yaw_rad", &R::yaw_rad), column("misfit", &R::misfit)};
  }
};

/// Where wrong pairs begin to show by their residuals.
bool small(const Motion& step) {
  return step.head<2>().norm() < 2e-3 && std::fabs(step.z()) < 1e-3;
}
bool still(const Motion& step) {
  return step.head<2>().norm() < 1e-6 && std::fabs(step.z()) < 1e-7;
}
/// Pairs that change places with each other keep a pose from coming to rest; it is known better than that moves it.
bool nearly_still(const Motion& step) {
  return step.head<2>().norm() < 1e-4 && std::fabs(step.z()) < 2e-5;
}

}  // namespace

Match register_points_on_lines(const ReturnedPoints& reference, const std::vector<LocalLine>& lines,
                               const ReturnedPoints& current, const std::vector<LocalLine>& current_lines,
                               const Guess& guess, const RegistrationRules& rules, Trace& trace) {
  const double lever = lever_of(current);
  std::vector<Vec2> on_lines;
  on_lines.reserve(current.size());
  for (std::size_t k = 0; k < current.size(); ++k) on_lines.push_back(current_lines[k].project(current.points[k]));
  NearestReturn nearest(reference);
  std::vector<Track> tracks(current.size());
  Pose2 pose = guess.pose();
  PairInformation information;
  bool settled = false, near = false;
  double last_size = 0.0;
  for (int iteration = 0; iteration < rules.max_iterations && !settled; ++iteration) {
    std::vector<Pair> pairs = nearest_pairs(current, pose, rules.gate_m, nearest, tracks);
    const double overlap = static_cast<double>(pairs.size()) / static_cast<double>(current.size());
    if (current.size() == 0 || !(overlap >= rules.min_overlap)) return no_match(guess.pose());
    keep_aligned(pairs, lines, current_lines, pose);
    for (Pair& pair : pairs) {
      pair.point = pose * on_lines[pair.current];
      pair.residual = lines[pair.reference].distance(pair.point);
    }
    // Far from the pose the largest residuals are those of far walls, which know the heading best.
    set_noise(pairs, current, lines, pose);
    if (near)
      trim(pairs, rules.trim, rules.by_noise);
    else
      keep_nearest(pairs, rules.keep);
    information = pair_information(pairs, lines, pose);
    const Motion step = Determined(information.equations, lever, kLeastRatioOfPoints).solve(information.equations.rhs);
    pose = moved(pose, step);
    const double size = step.head<2>().norm() + lever * std::fabs(step.z());
    settled = near && (still(step) || (nearly_still(step) && size > 0.5 * last_size));
    last_size = size;
    near = near || small(step) || iteration == rules.max_iterations / 2;
    trace.row(PointLineIterationRow{static_cast<int>(pairs.size()), step.x(), step.y(), step.z(), information.misfit});
  }
  return conclusion(information, pose, guess, rules.held, lever, settled);
}

}  // namespace scanbench::matching
