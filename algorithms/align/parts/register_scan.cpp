// Gauss-Newton iterations of segment-point registration.
#include "algorithms/align/parts/register_scan.hpp"

namespace scanbench::align {
namespace {

constexpr int kMostRegistrationSteps = 20;

}  // namespace

Pose2 register_scan(const ScanShape& scan, const LineGrid& lines, const Pose2& predicted, PartnerRules rules,
                    const Gates& gates) {
  Pose2 pose = predicted;
  for (int iteration = 0; iteration < kMostRegistrationSteps; ++iteration) {
    rules.gate_m = gates.at(iteration);
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    for (const Reading& reading : scan.readings) {
      const Sighting seen = placed(reading, pose);
      lines.for_each_nearest(seen, rules, [&](const PlacedLine& line, double distance) {
        const Eigen::Vector3d row = row_of(perpendicular(line.direction), seen.point, seen.sensor, scan.lever_m);
        const double weight = tukey_weight(distance, rules.gate_m);
        matrix += weight * row * row.transpose();
        gradient += weight * distance * row;
      });
    }
    const Observable free = observable(matrix);
    const Eigen::VectorXd along = (free.motions.transpose() * gradient).cwiseQuotient(free.eigenvalues);
    const Move move = move_by(-(free.motions * along), scan.lever_m, pose);
    if (gates.narrow(iteration) && move.small()) break;
  }
  return pose;
}

}  // namespace scanbench::align
