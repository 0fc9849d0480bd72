// First-order propagation of the noise of the readings through a line fit, held against the fits of parts of the line.
#include "algorithms/extract/parts/covariance.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "core/geometry/portable_math.hpp"
#include "core/geometry/symmetric_matrix.hpp"
#include "core/index.hpp"

namespace scanbench::extract {

namespace {

constexpr std::size_t kBlocks = 5;  // of neighbouring points
// Variance by the jackknife over that by the noise, in the direction where it is largest, from which on the points
// count as more than noise. Noise alone exceeds it in about one line of four.
constexpr double kMoreThanNoise = 3.0;

// Offset at a point along the normal of `reference`, and angle, of a line from `reference`.
Eigen::Vector2d shift(const LineFit& line, const PolarLine& reference, const Vec2& at) {
  const Vec2 m = reference.normal();
  const double side = line.normal.dot(m) < 0 ? -1.0 : 1.0;
  const Vec2 n = side * line.normal;
  return {side * line.offset - n.dot(at), portable::atan2(cross(m, n), m.dot(n))};
}

/// Covariance of shift() by the line fits without one of `blocks` blocks of neighbouring points, (b - 1)/b sum d d^T.
/// Absent if one of them has no direction.
std::optional<Eigen::Matrix2d> block_jackknife(const ScanPoints& points, std::span<const int> support,
                                               std::size_t blocks, const PolarLine& line, const Vec2& at) {
  std::array<PointMoments, kBlocks> moments;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t first = b * support.size() / blocks, end = (b + 1) * support.size() / blocks;
    moments[b] = moments_of(points.points, support.subspan(first, end - first));
  }
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (std::size_t left_out = 0; left_out < blocks; ++left_out) {
    PointMoments rest;
    for (std::size_t b = 0; b < blocks; ++b)
      if (b != left_out) rest.add(moments[b]);
    const LineFit fit = fit_line(rest);
    if (fit.degenerate) return std::nullopt;
    const Eigen::Vector2d d = shift(fit, line, at);
    sum += d * d.transpose();
  }
  return static_cast<double>(blocks - 1) / static_cast<double>(blocks) * sum;
}

}  // namespace

std::optional<Eigen::Matrix2d> tls_covariance(const Scan& scan, const ScanPoints& points, std::span<const int> support,
                                              const PolarLine& line, const Vec2& at) {
  const Vec2 normal = line.normal();
  const Vec2 along = perpendicular(normal);
  const PointMoments moments = moments_of(points.points, support);
  const double n = moments.weight();
  const SensorNoise& noise = scan.sensor.noise;
  double spread = 0.0;                                          // sum of tau^2
  double sum_var = 0.0, sum_tau_var = 0.0, sum_tau2_var = 0.0;  // of var h, tau var h, tau^2 var h
  for (const int i : support) {
    const auto k = as_index(i);
    const Vec2& p = points.points[k];
    const double range = scan.ranges[as_index(points.beams[k])];
    const Vec2& beam = scan.sensor.geometry.direction(points.beams[k]);
    const double by_range = noise.range_sigma(range) * normal.dot(beam);
    const double by_bearing = noise.bearing_sigma_rad * range * along.dot(beam);
    const double var = by_range * by_range + by_bearing * by_bearing;
    const double tau = along.dot(p - moments.centroid());
    spread += tau * tau;
    sum_var += var;
    sum_tau_var += tau * var;
    sum_tau2_var += tau * tau * var;
  }
  if (!(sum_var > 0) || !(spread > 10.0 * sum_var)) return std::nullopt;
  // First at the centroid, then at `at`, t along the line, where a rotation by e moves the line by -t e.
  const double var_offset = sum_var / (n * n);
  const double covariance = -sum_tau_var / (n * spread);
  const double var_angle = sum_tau2_var / (spread * spread);
  const double t = along.dot(at - moments.centroid());
  Eigen::Matrix2d result;
  result(0, 0) = var_offset - 2.0 * t * covariance + t * t * var_angle;
  result(0, 1) = result(1, 0) = covariance - t * var_angle;
  result(1, 1) = var_angle;
  return result;
}

std::optional<Eigen::Matrix2d> checked_covariance(const Scan& scan, const ScanPoints& points,
                                                  std::span<const int> support, const PolarLine& line, const Vec2& at) {
  const auto by_noise = tls_covariance(scan, points, support, line, at);
  const std::size_t blocks = std::min(kBlocks, support.size());
  if (!by_noise || blocks < 3) return by_noise;
  const auto jackknife = block_jackknife(points, support, blocks, line, at);
  if (!jackknife) return std::nullopt;
  // In coordinates in which the noise has the covariance 1: the jackknife's is l^-1 J l^-T.
  const Eigen::Matrix2d l = by_noise->llt().matrixL();
  const Eigen::Matrix2d inverse = l.inverse();
  const auto [values, vectors] = symmetric_eigen(Eigen::Matrix2d(inverse * *jackknife * inverse.transpose()));
  if (!(values[1] > kMoreThanNoise)) return by_noise;
  const Eigen::Matrix2d larger = vectors * values.cwiseMax(1.0).asDiagonal() * vectors.transpose();
  return l * larger * l.transpose();
}

void add_covariances(const Scan& scan, const ScanPoints& points, ScanLines& lines) {
  std::vector<std::vector<int>> supports(lines.lines.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const int line = lines.labels[as_index(points.beams[k])];
    if (line >= 0) supports[as_index(line)].push_back(static_cast<int>(k));
  }
  for (std::size_t k = 0; k < supports.size(); ++k) {
    LineFeature& f = lines.lines[k];
    // By place along the line: in a full turn the scan may begin in the middle of it.
    std::ranges::stable_sort(supports[k], {},
                             [&](int i) { return perpendicular(f.line.normal()).dot(points.points[as_index(i)]); });
    f.covariance = checked_covariance(scan, points, supports[k], f.line, f.segment.midpoint());
  }
}

}  // namespace scanbench::extract
