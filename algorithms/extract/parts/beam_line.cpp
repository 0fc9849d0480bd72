// Gauss-Newton fit of 1/range = theta . direction. docs/algorithms/optimal.md, section 5.
#include "algorithms/extract/parts/beam_line.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace scanbench::extract {
namespace {

// A frame whose x axis points to the middle reading. The two coordinates of theta are nearly uncorrelated in it, so
// that the normal equations are well conditioned even for a few beams.
struct MiddleFrame {
  Vec2 axis;
  Vec2 to(const Vec2& v) const { return {axis.dot(v), cross(axis, v)}; }
  Vec2 from(const Vec2& v) const { return v.x() * axis + v.y() * perpendicular(axis); }
};

struct Normal {
  Eigen::Matrix2d matrix = Eigen::Matrix2d::Zero();
  Vec2 rhs = Vec2::Zero();

  void add(const Vec2& g, double weight, double error) {
    const double wx = weight * g.x(), wy = weight * g.y();
    matrix(0, 0) += wx * g.x();
    matrix(0, 1) += wx * g.y();
    matrix(1, 1) += wy * g.y();
    rhs += (weight * error) * g;
  }
  std::optional<Vec2> solve() {
    matrix(1, 0) = matrix(0, 1);
    const double det = matrix(0, 0) * matrix(1, 1) - matrix(0, 1) * matrix(0, 1);
    if (!(det > 1e-14 * matrix(0, 0) * matrix(0, 0))) return std::nullopt;
    return Vec2((matrix(1, 1) * rhs.x() - matrix(0, 1) * rhs.y()) / det,
                (matrix(0, 0) * rhs.y() - matrix(0, 1) * rhs.x()) / det);
  }
};

}  // namespace

double reading_sigma(const SensorNoise& noise, double r, double slope) {
  const double range = noise.range_sigma(r);
  const double bearing = noise.bearing_sigma_rad * slope;
  return std::max(std::sqrt(range * range + bearing * bearing), kLeastSigma);
}

std::optional<BeamLine> fit_beam_line(std::span<const BeamReading> readings, const SensorNoise& noise,
                                      const std::optional<Vec2>& start) {
  if (readings.size() < 2) return std::nullopt;
  const MiddleFrame frame{readings[readings.size() / 2].direction};
  Vec2 theta;
  if (start) {
    theta = frame.to(*start);
  } else {
    Normal linear;
    for (const BeamReading& b : readings) {
      const double s = reading_sigma(noise, b.range_m, 0.0);
      const double w = b.range_m * b.range_m / s;
      linear.add(frame.to(b.direction), w * w, 1.0 / b.range_m);
    }
    const auto solution = linear.solve();
    if (!solution) return std::nullopt;
    theta = *solution;
  }

  // Error of a reading z in standard deviations: (z - 1/u) / s, u = theta . g. Its derivative by theta is g r^2 / s.
  Normal normal;
  for (int iteration = 0; iteration < 20; ++iteration) {
    normal = {};
    for (const BeamReading& b : readings) {
      const Vec2 g = frame.to(b.direction);
      const double u = theta.dot(g);
      if (!(u > 0)) return std::nullopt;
      const double r = 1.0 / u;
      const double s = reading_sigma(noise, r, r * r * (theta.x() * g.y() - theta.y() * g.x()));
      const double w = r * r / s;
      normal.add(g, w * w, (r - b.range_m) / (r * r));
    }
    auto step = normal.solve();
    if (!step) return std::nullopt;
    // After a step the line must be in front of the first and the last beam; it is then in front of all beams.
    const Vec2 first = frame.to(readings.front().direction), last = frame.to(readings.back().direction);
    for (int halving = 0; halving < 30; ++halving) {
      const Vec2 next = theta + *step;
      if (next.dot(first) > 0.2 * theta.dot(first) && next.dot(last) > 0.2 * theta.dot(last)) break;
      *step *= 0.5;
    }
    theta += *step;
    if (step->squaredNorm() <= 1e-24 * theta.squaredNorm()) break;
  }

  BeamLine line;
  line.theta = frame.from(theta);
  Eigen::Matrix2d rotation;  // rows: the frame's axes
  rotation << frame.axis.x(), frame.axis.y(), -frame.axis.y(), frame.axis.x();
  line.information = rotation.transpose() * normal.matrix * rotation;
  return line;
}

Eigen::Matrix2d line_covariance(const BeamLine& line, const Vec2& point) {
  // rho = 1/|theta|, so d rho = -rho^2 n . d theta; d alpha = rho t . d theta with t = n rotated by 90 degrees. A point
  // at tangential coordinate tau moves across the line by d rho - tau d alpha.
  const Vec2 n = line.normal();
  const Vec2 t = perpendicular(n);
  const double rho = line.rho();
  Eigen::Matrix2d jacobian;
  jacobian.row(1) = rho * t.transpose();
  jacobian.row(0) = -rho * rho * n.transpose() - t.dot(point) * jacobian.row(1);
  return jacobian * line.information.inverse() * jacobian.transpose();
}

}  // namespace scanbench::extract
