// First-order propagation of the noise of the readings through a line fit.
#include "algorithms/extract/parts/covariance.hpp"

#include <algorithm>
#include <cstddef>

#include <Eigen/LU>

#include "core/geometry/portable_math.hpp"
#include "core/index.hpp"

namespace scanbench::extract {

namespace {

constexpr std::size_t kMostTrimmed = 5;  // points at each end, and at most a fifth of all
// Squared Mahalanobis distance (two degrees of freedom) between the lines with and without the ends, from which on the
// ends count as foreign. Noise alone exceeds it in one line of seven.
constexpr double kForeign = 4.0;

// Offset at a point along the normal of `reference`, and angle, of a line from `reference`.
Eigen::Vector2d shift(const LineFit& line, const PolarLine& reference, const Vec2& at) {
  const Vec2 m = reference.normal();
  const double side = line.normal.dot(m) < 0 ? -1.0 : 1.0;
  const Vec2 n = side * line.normal;
  return {side * line.offset - n.dot(at), portable::atan2(cross(m, n), m.dot(n))};
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
  const auto whole = tls_covariance(scan, points, support, line, at);
  const std::size_t n = support.size();
  const std::size_t trim = std::min(kMostTrimmed, n / 5);
  if (!whole || trim == 0) return whole;
  const auto inner = support.subspan(trim, n - 2 * trim);
  const LineFit fit = fit_line(moments_of(points.points, inner));
  const auto trimmed = tls_covariance(scan, points, inner, line, at);
  if (fit.degenerate || !trimmed) return std::nullopt;
  const Eigen::Vector2d d = shift(fit, line, at);
  // The fit to all points is the more exact one, so the difference of the two has the difference of their covariances.
  const Eigen::Matrix2d expected = *trimmed - *whole;
  if (expected(0, 0) > 0 && expected.determinant() > 0 && d.dot(expected.inverse() * d) <= kForeign) return whole;
  return *trimmed + d * d.transpose();
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
