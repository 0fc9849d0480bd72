// One iteration of the fuzzy clustering of points into two lines with the fuzzifier 2, four points at a time.
#pragma once

namespace scanbench::extract {

inline constexpr int kFuzzyLanes = 4;
inline constexpr double kZeroDistance2 = 1e-18;  ///< [m^2] a point this close to a prototype belongs to it

/// Coordinates of points, in arrays with space for a multiple of kFuzzyLanes.
struct PointArrays {
  const double* x;
  const double* y;
  int count;
};

/// Prototypes as in fuzzy_clustering.hpp.
struct TwoLines {
  double normal_x[2], normal_y[2], rho[2], centre_x[2], centre_y[2];
  bool penalty;
};

/// Of each cluster, the sum of the weights u^2 and of the weighted differences from the prototype's centre.
struct TwoMeans {
  double cost;  ///< J, eq. (1)
  double weight[2], x[2], y[2];
};

/// Weighted second moments about two given points.
struct TwoMoments {
  double xx[2], xy[2], yy[2];
};

struct FuzzyKernels {
  /// Eq. (6) for all points. u[0] and u[1] have space for a multiple of kFuzzyLanes.
  TwoMeans (*memberships)(const PointArrays& points, const TwoLines& lines, double* const u[2]);
  TwoMoments (*moments)(const PointArrays& points, const double* const u[2], const double centre_x[2],
                        const double centre_y[2]);
};

namespace baseline {
extern const FuzzyKernels kFuzzyKernels;
}
namespace v3 {
extern const FuzzyKernels kFuzzyKernels;
}

}  // namespace scanbench::extract
