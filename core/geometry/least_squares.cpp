// Central moments of points and the line that they determine.
#include "core/geometry/least_squares.hpp"

#include <cmath>

#include "core/geometry/portable_math.hpp"

namespace scanbench {

PointMoments PointMoments::of(std::span<const Vec2> points) {
  PointMoments m;
  if (points.empty()) return m;
  const std::size_t n = points.size();
  const std::size_t paired = n - n % 2;
  const Vec2& origin = points.front();  // so that equal points have moments of exactly zero
  // Even and odd points have a sum each, so that an addition does not wait for the previous one.
  Vec2 even = Vec2::Zero(), odd = Vec2::Zero();
  for (std::size_t i = 0; i < paired; i += 2) {
    even += points[i] - origin;
    odd += points[i + 1] - origin;
  }
  if (paired < n) even += points[paired] - origin;
  m.weight_ = static_cast<double>(n);
  m.centroid_ = origin + (even + odd) / m.weight_;
  Vec2 squares_even = Vec2::Zero(), squares_odd = Vec2::Zero();
  double product_even = 0.0, product_odd = 0.0;
  for (std::size_t i = 0; i < paired; i += 2) {
    const Vec2 p = points[i] - m.centroid_;
    const Vec2 q = points[i + 1] - m.centroid_;
    squares_even += p.cwiseProduct(p);
    squares_odd += q.cwiseProduct(q);
    product_even += p.x() * p.y();
    product_odd += q.x() * q.y();
  }
  if (paired < n) {
    const Vec2 p = points[paired] - m.centroid_;
    squares_even += p.cwiseProduct(p);
    product_even += p.x() * p.y();
  }
  const Vec2 squares = squares_even + squares_odd;
  m.sxx_ = squares.x();
  m.syy_ = squares.y();
  m.sxy_ = product_even + product_odd;
  return m;
}

PointMoments PointMoments::given(double weight, const Vec2& centroid, double sxx, double sxy, double syy) {
  PointMoments m;
  m.weight_ = weight;
  m.centroid_ = centroid;
  m.sxx_ = sxx;
  m.sxy_ = sxy;
  m.syy_ = syy;
  return m;
}

void PointMoments::add(const Vec2& p, double weight) {
  if (!(weight > 0)) return;
  const Vec2 before = p - centroid_;
  weight_ += weight;
  centroid_ += (weight / weight_) * before;
  const Vec2 after = p - centroid_;
  sxx_ += weight * before.x() * after.x();
  sxy_ += weight * before.x() * after.y();
  syy_ += weight * before.y() * after.y();
}

void PointMoments::add(const PointMoments& other) {
  if (!(other.weight_ > 0)) return;
  const double total = weight_ + other.weight_;
  const Vec2 d = other.centroid_ - centroid_;
  const double w = weight_ * other.weight_ / total;
  sxx_ += other.sxx_ + w * d.x() * d.x();
  sxy_ += other.sxy_ + w * d.x() * d.y();
  syy_ += other.syy_ + w * d.y() * d.y();
  centroid_ += (other.weight_ / total) * d;
  weight_ = total;
}

PolarLine LineFit::polar() const {
  return canonical(offset, portable::atan2(normal.y(), normal.x()));
}

LineFit fit_line(const PointMoments& m) {
  LineFit fit;
  fit.centroid = m.centroid();
  fit.weight = m.weight();
  const double difference = m.sxx() - m.syy();
  const double root = std::sqrt(difference * difference + 4.0 * m.sxy() * m.sxy());
  if (root > 0) {
    // The line's direction is the eigenvector of the larger eigenvalue, (sxx + syy + root) / 2. It has two forms; this
    // is the one without cancellation.
    const Vec2 along =
        difference >= 0 ? Vec2(difference + root, 2.0 * m.sxy()) : Vec2(2.0 * m.sxy(), root - difference);
    fit.normal = perpendicular(along / std::sqrt(along.squaredNorm()));
    fit.degenerate = false;
  }
  fit.offset = fit.normal.dot(fit.centroid);
  const double twice_residual = (m.sxx() + m.syy()) - root;
  fit.residual_sum = twice_residual > 0 ? 0.5 * twice_residual : 0.0;
  return fit;
}

LineFit fit_line(std::span<const Vec2> points) {
  return fit_line(PointMoments::of(points));
}

}  // namespace scanbench
