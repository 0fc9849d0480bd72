// The parabola through three errors along a line.
#include "algorithms/match/parts/extrapolation.hpp"

#include <algorithm>

namespace scanbench::matching {
namespace {

constexpr double kSameDirection = 0.985;  // cosine of 10 degrees
constexpr double kLongest = 25.0;

bool same_direction(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double lengths = a.norm() * b.norm();
  return lengths > 0 && a.dot(b) > kSameDirection * lengths;
}

}  // namespace

double Extrapolation::factor(const Eigen::Vector3d& step, double error) {
  double result = 1.0;
  if (same_direction(step, last_.step) && same_direction(last_.step, last_but_one_.step)) {
    // Places along the line: 0 before this step, v1 and v2 before the last two.
    const double v1 = -last_.step.norm(), v2 = v1 - last_but_one_.step.norm();
    const double slope = (error - last_.error) / -v1;
    const double slope_before = (last_.error - last_but_one_.error) / (v1 - v2);
    const double curvature = (slope - slope_before) / -v2;
    if (curvature > 0) result = std::clamp((0.5 * v1 - 0.5 * slope / curvature) / step.norm(), 1.0, kLongest);
  }
  last_but_one_ = last_;
  last_ = {result * step, error};
  return result;
}

}  // namespace scanbench::matching
