// Sums of a truncated Gaussian kernel over a list of candidates in float: the inner loop of mean shift (Lakaemper 2009,
// eq. 1), computed by sum_kernels.hpp.
//
// Coordinates are in units of the kernel's standard deviation, relative to the centre of a box. So the resolution of
// float is about 1e-6 standard deviations, independent of the distance of the map from the origin. Only + - * are used,
// always in the same order, so the sums do not depend on compiler options or on the CPU. Modes are made exact
// afterwards, in double (mode_polish.hpp).
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "algorithms/merge/mean_shift/sum_kernels.hpp"
#include "algorithms/merge/parts/point_grid.hpp"
#include "core/isa.hpp"

namespace scanbench::merge {

struct Float3 {
  float x = 0.0F;
  float y = 0.0F;
  float z = 0.0F;

  static Float3 rounded(const Eigen::Vector3d& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
  }
  float squared_norm() const { return x * x + y * y + z * z; }
};

/// The mean shift m(t) - t (eq. 1) and the sum of its weights, which is 0 if no candidate is within the cut-off.
struct Shift {
  float mass = 0.0F;
  Float3 step;
};

/// The mean shift; the kernel-weighted covariance about m(t); and the density that eq. 1 climbs if the kernel is cut
/// off at c: the sum of exp(-d^2/2) - exp(-c^2/2). I - covariance is minus the Hessian of the log density.
struct ShiftAndCovariance {
  Shift shift;
  float density = 0.0F;
  float xx = 0.0F;
  float xy = 0.0F;
  float xz = 0.0F;
  float yy = 0.0F;
  float yz = 0.0F;
  float zz = 0.0F;
};

/// Candidates in arrays of eight. Call add() and add_near() for all of them, then seal(), then the sums.
class CandidateList {
 public:
  explicit CandidateList(Isa isa = best_isa());

  void clear();
  void add(Float3 p);
  /// Adds p - centre, rounded, for all points p of the grid within `radius` of the box centre +- half.
  void add_near(const PointGrid& grid, const Vec3& centre, const Vec3& half, double radius);
  /// Fills the arrays up with points beyond every cut-off.
  void seal();

  /// Candidates farther than sqrt(squared_cutoff) from t have weight 0.
  Shift shift(Float3 t, float squared_cutoff) const;
  ShiftAndCovariance shift_and_covariance(Float3 t, float squared_cutoff) const;

 private:
  CandidateArrays arrays() const { return {x_.data(), y_.data(), z_.data(), static_cast<int>(count_)}; }
  void make_space(std::size_t more);

  const SumKernels* kernels_;
  std::vector<float> x_, y_, z_;  ///< longer than count_
  std::size_t count_ = 0;
};

}  // namespace scanbench::merge
