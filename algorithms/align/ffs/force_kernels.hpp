// Forces between pairs of points in single precision, eight pairs at a time; each pair is computed once and acts on
// both of its points.
#pragma once

#include <cstdint>

namespace scanbench::align::ffs {

inline constexpr int kForceLanes = 8;

/// Points with the sums of the forces on them, in arrays that extend kForceLanes beyond the last point.
struct ForceArrays {
  const float *x, *y;
  const float *c, *s;  ///< direction times weight; the product of two points is w_v w_u cos(angle)
  const std::int32_t* body;
  float *fx, *fy, *stiffness;
};

struct ForceConstants {
  float exponent;  ///< -log2(e) / (2 sigma^2)
  float squared_cut;
  float stiffest;  ///< largest 1 / d
};

struct ForceKernels {
  /// Adds the forces of the pairs of each point at a place first .. last - 1 with the points at places begin .. end - 1
  /// that come after it.
  void (*attract)(const ForceArrays& points, const ForceConstants& constants, int first, int last, int begin, int end);
};

namespace baseline {
extern const ForceKernels kForceKernels;
}
namespace v3 {
extern const ForceKernels kForceKernels;
}

}  // namespace scanbench::align::ffs
