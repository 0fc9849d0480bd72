// Total least squares from central moments.
#include "core/least_squares.hpp"

#include <cmath>

#include "core/portable_math.hpp"

namespace scanbench {

PointMoments PointMoments::of(std::span<const Vec2> points) {
  PointMoments m;
  if (points.empty()) return m;
  const Vec2 origin = points.front();  // so that equal points have moments of exactly zero
  double sx = 0.0, sy = 0.0;
  for (const Vec2& p : points) {
    sx += p.x() - origin.x();
    sy += p.y() - origin.y();
  }
  m.weight_ = static_cast<double>(points.size());
  m.centroid_ = {origin.x() + sx / m.weight_, origin.y() + sy / m.weight_};
  for (const Vec2& p : points) {
    const double x = p.x() - m.centroid_.x();
    const double y = p.y() - m.centroid_.y();
    m.sxx_ += x * x;
    m.sxy_ += x * y;
    m.syy_ += y * y;
  }
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
    // Direction of the line: the eigenvector of the larger eigenvalue (sum + root)/2; of its two forms the one that
    // does not cancel.
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
