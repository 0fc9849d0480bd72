// Closed form with headings as further points: a pose is its position and, with equal weights, two points `lever` ahead
// of and behind it, which are brought together like positions. Their sums of cross and dot products are added to those
// of the centred positions.
#include "core/geometry/plane_alignment.hpp"

#include <cmath>

#include "core/error.hpp"

namespace scanbench {

Pose2 align_trajectories(std::span<const Pose2> estimated, std::span<const Pose2> truth, double lever_m) {
  SCANBENCH_ASSERT(estimated.size() == truth.size());
  if (estimated.empty()) return {};
  const auto n = static_cast<double>(estimated.size());
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();
  for (std::size_t k = 0; k < estimated.size(); ++k) {
    from += estimated[k].translation() / n;
    to += truth[k].translation() / n;
  }
  double sine = 0.0, cosine = 0.0;
  const auto add = [&](const Vec2& a, const Vec2& b, double weight) {
    sine += weight * cross(a, b);
    cosine += weight * a.dot(b);
  };
  for (std::size_t k = 0; k < estimated.size(); ++k) {
    add(estimated[k].translation() - from, truth[k].translation() - to, 1.0);
    add({estimated[k].cos(), estimated[k].sin()}, {truth[k].cos(), truth[k].sin()}, lever_m * lever_m);
  }
  const double size = std::hypot(sine, cosine);
  const Vec2 rotation = size > 0 ? Vec2(cosine / size, sine / size) : Vec2(1.0, 0.0);
  const Pose2 turn = Pose2::from_unit({0, 0}, rotation);
  return Pose2::from_unit(to - turn.rotate(from), rotation);
}

}  // namespace scanbench
