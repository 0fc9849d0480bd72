// The inner loops of mean shift in lanes: sums of a truncated Gaussian kernel in float, eight candidates at once, and
// the selection of candidates, four points at once in double.
#pragma once

namespace scanbench::merge {

inline constexpr int kSumLanes = 8;
inline constexpr int kNearLanes = 4;

/// Coordinates of candidates: `count` is a multiple of kSumLanes.
struct CandidateArrays {
  const float* x;
  const float* y;
  const float* z;
  int count;
};

/// Sums over candidates d = p - t, weighted by w = exp(-d^2 / 2) up to the cut-off: of w, w d and, in second order, of
/// exp(-d^2 / 2) - exp(-c^2 / 2) and the products of the coordinates.
struct FirstSums {
  float mass, x, y, z;
};
struct SecondSums {
  FirstSums first;
  float density, xx, xy, xz, yy, yz, zz;
};

/// The points within `radius` of the box centre +- half. With period > 0 the third coordinate is periodic.
struct NearBox {
  double centre[3];
  double half[3];
  double squared_radius;
  double period;
};

struct SumKernels {
  /// exp(-squared[i] / 2), relative error below 8e-6, for 0 <= squared <= 160 and kSumLanes numbers.
  void (*gaussian)(const float* squared, float* out);
  FirstSums (*first)(const CandidateArrays& candidates, const float t[3], float squared_cutoff);
  SecondSums (*second)(const CandidateArrays& candidates, const float t[3], float squared_cutoff);
  /// Writes p - centre of the near points among `count` points and returns their number. Each output has space for
  /// `count` numbers.
  int (*select)(const double* x, const double* y, const double* z, int count, const NearBox& box, float* out_x,
                float* out_y, float* out_z);
};

namespace baseline {
extern const SumKernels kSumKernels;
}
namespace v3 {
extern const SumKernels kSumKernels;
}

}  // namespace scanbench::merge
