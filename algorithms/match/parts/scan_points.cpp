// Lines through windows of neighbouring returns, from running sums of moments.
#include "algorithms/match/parts/scan_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace scanbench::matching {
namespace {

constexpr double kAngleSigma = 0.05;  // rad; a window grows until its line's angle is as certain
constexpr std::size_t kMostNeighbours = 60;
constexpr int kMostMissing = 3;           // beams within a window
constexpr double kLeastBeamCosine = 0.2;  // of a beam with the normal
constexpr double kCornerSigmas = 1.5;     // largest root mean square residual of a line

/// Sums of x, y and their products over the points before one.
struct Sums {
  double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
};

class Windows {
 public:
  explicit Windows(const ReturnedPoints& scan) : sums_(scan.size() + 1) {
    for (std::size_t k = 0; k < scan.size(); ++k) {
      const Vec2& p = scan.points[k];
      const Sums& s = sums_[k];
      sums_[k + 1] = {s.x + p.x(), s.y + p.y(), s.xx + p.x() * p.x(), s.xy + p.x() * p.y(), s.yy + p.y() * p.y()};
    }
  }

  struct Fit {
    LocalLine line;
    double mean_square = 0.0;  // of the residuals
    double spread = 0.0;       // sum of squares along the line
    int missing = 0;           // beams between the first and the last one without a return
  };
  /// Through points first .. last, whose noise is along the beam `direction`. Noise across a beam that meets the wall
  /// obliquely is correlated with noise along the wall, and would turn the line of least squares; its share in the
  /// moments is known and is taken out.
  Fit fit(std::size_t first, std::size_t last, const Vec2& direction, double sigma) const {
    const Sums& a = sums_[first];
    const Sums& b = sums_[last + 1];
    const auto n = static_cast<double>(last - first + 1);
    Fit result;
    result.line.centre = {(b.x - a.x) / n, (b.y - a.y) / n};
    const Vec2& c = result.line.centre;
    const double xx = b.xx - a.xx - n * c.x() * c.x();
    const double xy = b.xy - a.xy - n * c.x() * c.y();
    const double yy = b.yy - a.yy - n * c.y() * c.y();
    const double noise = n * sigma * sigma;
    const double half_difference =
        0.5 * (xx - yy - noise * (direction.x() * direction.x() - direction.y() * direction.y()));
    const double product = xy - noise * direction.x() * direction.y();
    const double root = std::sqrt(half_difference * half_difference + product * product);
    if (!(root > 0)) return result;
    // The larger of two proportional forms of the direction of the larger eigenvalue: no cancellation.
    const Vec2 along =
        half_difference > 0 ? Vec2(half_difference + root, product) : Vec2(product, root - half_difference);
    const Vec2 normal = perpendicular(along.normalized());
    result.line.normal = normal;
    const double across =
        normal.x() * normal.x() * xx + 2 * normal.x() * normal.y() * xy + normal.y() * normal.y() * yy;
    result.spread = std::max(xx + yy - across, 0.0);
    result.mean_square = std::max(across, 0.0) / n;
    return result;
  }

 private:
  std::vector<Sums> sums_;
};

/// Noise across a line at return k.
double noise_across(const ReturnedPoints& scan, std::size_t k, const LocalLine& line) {
  return std::max(scan.sigmas[k], kLeastSigmaM) *
         std::max(std::fabs(line.normal.dot(scan.direction(k))), kLeastBeamCosine);
}

class Lines {
 public:
  explicit Lines(const ReturnedPoints& scan) : scan_(scan), windows_(scan) {}

  /// Windows change little from return to return: each begins with the size of the one before it.
  LocalLine next() {
    const std::size_t k = next_++;
    size_ = std::max<std::size_t>(3, size_ - size_ / 8);
    while (!long_enough(k, middle(k)) && size_ < most()) size_ = std::min(size_ + 1 + size_ / 8, most());
    return best(k);
  }

 private:
  std::size_t most() const { return std::min(kMostNeighbours, scan_.size()); }
  Windows::Fit window(std::size_t k, std::size_t before) const {
    const std::size_t start = std::min(k - std::min(k, before), scan_.size() - size_);
    Windows::Fit result = windows_.fit(start, start + size_ - 1, scan_.direction(k), scan_.sigmas[k]);
    result.missing = scan_.beams[start + size_ - 1] - scan_.beams[start] - static_cast<int>(size_ - 1);
    return result;
  }
  Windows::Fit middle(std::size_t k) const { return window(k, (size_ - 1) / 2); }
  bool long_enough(std::size_t k, const Windows::Fit& fit) const {
    const double noise = noise_across(scan_, k, fit.line);
    return noise * noise <= kAngleSigma * kAngleSigma * fit.spread;
  }

  LocalLine best(std::size_t k) const {
    Windows::Fit chosen = middle(k);
    const auto on_a_line = [&](const Windows::Fit& fit) {
      const double noise = noise_across(scan_, k, fit.line);
      return fit.line.known() && fit.missing <= kMostMissing &&
             fit.mean_square <= kCornerSigmas * kCornerSigmas * noise * noise &&
             std::fabs(fit.line.distance(scan_.points[k])) <= 3.0 * noise;
    };
    // Neighbours on both sides say more about the return between them than those on one.
    if (!on_a_line(chosen)) {
      const Windows::Fit before = window(k, size_ - 1), behind = window(k, 0);
      chosen = before.mean_square < behind.mean_square ? before : behind;
      if (!on_a_line(chosen)) return {};
    }
    const double noise = noise_across(scan_, k, chosen.line);
    chosen.line.angle_variance = noise * noise / chosen.spread;
    return chosen.line;
  }

  const ReturnedPoints& scan_;
  Windows windows_;
  std::size_t next_ = 0;
  std::size_t size_ = 3;
};

}  // namespace

ReturnedPoints returned_points(const Scan& scan) {
  ReturnedPoints result{scan, {}, {}, {}};
  result.points.reserve(scan.ranges.size());
  result.beams.reserve(scan.ranges.size());
  result.sigmas.reserve(scan.ranges.size());
  for (int i = 0; i < scan.beams(); ++i) {
    if (!scan.valid(i) || scan.ranges[static_cast<std::size_t>(i)] > kFarthestM) continue;
    result.points.push_back(scan.point(i));
    result.beams.push_back(i);
    result.sigmas.push_back(scan.sensor.noise.range_sigma(scan.ranges[static_cast<std::size_t>(i)]));
  }
  return result;
}

double lever_of(const ReturnedPoints& scan) {
  if (scan.size() == 0) return 1.0;
  std::vector<double> squares;
  squares.reserve(scan.size());
  for (const Vec2& p : scan.points) squares.push_back(p.squaredNorm());
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  return std::max(std::sqrt(*middle), 1e-3);
}

std::vector<LocalLine> local_lines(const ReturnedPoints& scan) {
  std::vector<LocalLine> lines(scan.size());
  if (scan.size() < 3) return lines;
  Lines in_order(scan);
  for (LocalLine& line : lines) line = in_order.next();
  return lines;
}

}  // namespace scanbench::matching
