// Orthogonal (total) least squares of a line: the fit of every module whose paper does not prescribe another.
#pragma once

#include <span>

#include "core/geometry/geometry.hpp"

namespace scanbench {

/// Count, mean and central second moments of points, by Welford's update, which subtracts no large sums. Metres.
class PointMoments {
 public:
  PointMoments() = default;
  /// The moments of points of weight 1, in two passes: as accurate as the update, without a division per point.
  static PointMoments of(std::span<const Vec2> points);
  /// Given moments: the sum of weights, the weighted mean, and the weighted second moments about it.
  static PointMoments given(double weight, const Vec2& centroid, double sxx, double sxy, double syy);
  void add(const Vec2& p, double weight = 1.0);
  void add(const PointMoments& other);

  double weight() const { return weight_; }
  const Vec2& centroid() const { return centroid_; }
  double sxx() const { return sxx_; }
  double sxy() const { return sxy_; }
  double syy() const { return syy_; }

 private:
  double weight_ = 0.0;
  Vec2 centroid_ = Vec2::Zero();
  double sxx_ = 0.0;
  double sxy_ = 0.0;
  double syy_ = 0.0;
};

/// A fitted line n . p = offset with unit normal n, and the sum of weighted squared orthogonal residuals.
struct LineFit {
  Vec2 normal{1.0, 0.0};
  double offset = 0.0;
  Vec2 centroid = Vec2::Zero();
  double weight = 0.0;
  double residual_sum = 0.0;
  /// The direction is undefined: fewer than two different points, or an isotropic cloud. The normal is then (1, 0).
  bool degenerate = true;

  double distance(const Vec2& p) const { return std::abs(normal.dot(p) - offset); }
  Vec2 project(const Vec2& p) const { return p - (normal.dot(p) - offset) * normal; }
  double rms() const { return weight > 0 ? std::sqrt(residual_sum / weight) : 0.0; }
  PolarLine polar() const;
};

/// The line through the centroid that minimises the sum of squared orthogonal distances. Rigid-motion equivariant,
/// exact for collinear points. No trigonometry: the normal is the eigenvector of the smaller eigenvalue of the central
/// moments.
LineFit fit_line(const PointMoments& moments);
LineFit fit_line(std::span<const Vec2> points);

}  // namespace scanbench
