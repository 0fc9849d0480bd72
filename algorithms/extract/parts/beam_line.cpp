// Gauss-Newton fit of 1/range = theta . direction. docs/algorithms/optimal.md, section 5.
#include "algorithms/extract/parts/beam_line.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

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

// The readings of a fit in its frame, in arrays for the kernels.
class FrameReadings {
 public:
  FrameReadings(std::span<const BeamReading> readings, const MiddleFrame& frame)
      : count_(readings.size()), stride_((count_ + kBeamLanes - 1) / kBeamLanes * kBeamLanes), data_(3 * stride_) {
    for (std::size_t i = 0; i < stride_; ++i) {
      const BeamReading& b = readings[std::min(i, count_ - 1)];
      const Vec2 g = frame.to(b.direction);
      data_[i] = g.x();
      data_[stride_ + i] = g.y();
      data_[2 * stride_ + i] = b.range_m;
    }
  }
  BeamArrays arrays() const {
    return {data_.data(), data_.data() + stride_, data_.data() + 2 * stride_, static_cast<int>(count_)};
  }

 private:
  std::size_t count_, stride_;
  std::vector<double> data_;
};

std::optional<Vec2> solution_of(const BeamSums& s) {
  const double det = s.xx * s.yy - s.xy * s.xy;
  if (!(det > 1e-14 * s.xx * s.xx)) return std::nullopt;
  return Vec2((s.yy * s.x - s.xy * s.y) / det, (s.xx * s.y - s.xy * s.x) / det);
}

// The squared length of a step in standard deviations of the line.
double squared_sigmas(const BeamSums& s, const Vec2& step) {
  return s.xx * step.x() * step.x() + 2.0 * s.xy * step.x() * step.y() + s.yy * step.y() * step.y();
}

// Each step is a tenth of the one before or less, so the error after a step of this length is smaller still.
constexpr double kSquaredStill = 1e-16;

}  // namespace

ReadingNoise::ReadingNoise(const SensorNoise& noise)
    : VarianceTerms{.constant_m2 = noise.sigma_m * noise.sigma_m,
                    .relative2 = noise.sigma_relative * noise.sigma_relative,
                    .relative_from_m = noise.relative_from_m,
                    .rounding_m2 = noise.quantum_m * noise.quantum_m / 12.0,
                    .bearing_rad2 = noise.bearing_sigma_rad * noise.bearing_sigma_rad,
                    .least_m2 = kLeastSigma * kLeastSigma} {}

double reading_sigma(const ReadingNoise& noise, double r, double slope) {
  return std::sqrt(noise.variance(r, slope));
}

std::optional<BeamLine> fit_beam_line(std::span<const BeamReading> readings, const ReadingNoise& noise,
                                      const std::optional<Vec2>& start, Isa isa) {
  if (readings.size() < 2) return std::nullopt;
  const BeamKernels& kernels = build_for(isa, baseline::kBeamKernels, v3::kBeamKernels);
  const MiddleFrame frame{readings[readings.size() / 2].direction};
  const FrameReadings in_frame(readings, frame);
  Vec2 theta;
  if (start) {
    theta = frame.to(*start);
  } else {
    const auto solution = solution_of(kernels.linear(in_frame.arrays(), noise));
    if (!solution) return std::nullopt;
    theta = *solution;
  }

  // Error of a reading z in standard deviations: (z - 1/u) / s, u = theta . g. Its derivative by theta is g r^2 / s.
  const Vec2 first = frame.to(readings.front().direction), last = frame.to(readings.back().direction);
  BeamSums normal{};
  for (int iteration = 0; iteration < 20; ++iteration) {
    normal = kernels.step(in_frame.arrays(), theta.data(), noise);
    if (!(normal.least_inverse_range > 0)) return std::nullopt;
    auto step = solution_of(normal);
    if (!step) return std::nullopt;
    // After a step the line must be in front of the first and the last beam; it is then in front of all beams.
    for (int halving = 0; halving < 30; ++halving) {
      const Vec2 next = theta + *step;
      if (next.dot(first) > 0.2 * theta.dot(first) && next.dot(last) > 0.2 * theta.dot(last)) break;
      *step *= 0.5;
    }
    theta += *step;
    if (squared_sigmas(normal, *step) <= kSquaredStill || step->squaredNorm() <= 1e-24 * theta.squaredNorm()) break;
  }

  BeamLine line;
  line.theta = frame.from(theta);
  Eigen::Matrix2d rotation;  // rows: the frame's axes
  rotation << frame.axis.x(), frame.axis.y(), -frame.axis.y(), frame.axis.x();
  Eigen::Matrix2d matrix;
  matrix << normal.xx, normal.xy, normal.xy, normal.yy;
  line.information = rotation.transpose() * matrix * rotation;
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
