// Sums of a truncated Gaussian kernel over a list of candidates, four at a time in float: the inner loop of mean shift
// (Lakaemper 2009, eq. 1).
//
// Everything is in units of the kernel's standard deviation and relative to the centre of a box, so that float keeps
// about 1e-6 standard deviations however far from the origin the map is. Only + - * are used and always in one order:
// the sums do not depend on the compiler's options or on the CPU. What must be exact is polished in double afterwards
// (mode_polish.hpp).
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

/// The mean shift m(t) - t (eq. 1) and the kernel mass behind it; mass 0 when no candidate lies inside the cut-off.
struct Shift {
  float mass = 0.0F;
  Float3 step;
};

/// The same, the kernel-weighted covariance about m(t) (I - covariance is minus the Hessian of the log density), and
/// the density that steps of eq. 1 climb when the kernel is cut off at c: the sum of exp(-d^2/2) - exp(-c^2/2).
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

/// Candidates in blocks of four. add() them all, then seal(), then ask.
class CandidateList {
 public:
  void clear();
  void add(Float3 p);
  /// Fills the last block up with points that are out of everybody's reach.
  void seal();

  /// Candidates farther than sqrt(squared_cutoff) from t weigh nothing.
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
