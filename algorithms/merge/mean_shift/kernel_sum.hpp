// Sums of a truncated Gaussian kernel over a list of candidates, four at a time in float: the inner loop of mean shift
// (Lakaemper 2009, eq. 1).
//
// Coordinates are in units of the kernel's standard deviation, relative to the centre of a box. So the resolution of
// float is about 1e-6 standard deviations, independent of the distance of the map from the origin. Only + - * are used,
// always in the same order, so the sums do not depend on compiler options or on the CPU. Modes are made exact
// afterwards, in double (mode_polish.hpp).
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace scanbench::merge {

using Float4 [[gnu::vector_size(16)]] = float;
using Word4 [[gnu::vector_size(16)]] = std::uint32_t;

struct Float3 {
  float x = 0.0F;
  float y = 0.0F;
  float z = 0.0F;

  static Float3 rounded(const Eigen::Vector3d& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
  }
  float squared_norm() const { return x * x + y * y + z * z; }
};

/// exp(-squared / 2), relative error below 8e-6, for 0 <= squared <= 160.
Float4 gaussian(Float4 squared);

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

/// Candidates in blocks of four. Call add() for all of them, then seal(), then the sums.
class CandidateList {
 public:
  void clear();
  void add(Float3 p);
  /// Fills the last block with points beyond every cut-off.
  void seal();

  /// Candidates farther than sqrt(squared_cutoff) from t have weight 0.
  Shift shift(Float3 t, float squared_cutoff) const;
  ShiftAndCovariance shift_and_covariance(Float3 t, float squared_cutoff) const;

 private:
  struct Block {
    Float4 x;
    Float4 y;
    Float4 z;
  };
  std::vector<Block> blocks_;
  int filled_ = 4;  ///< lanes used of the last block
};

}  // namespace scanbench::merge
