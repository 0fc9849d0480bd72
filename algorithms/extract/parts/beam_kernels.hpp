// Sums of the normal equations of a line in the coordinates of the beams, four readings at once.
#pragma once

namespace scanbench::extract {

inline constexpr int kBeamLanes = 4;

/// Parts of the variance of a reading, which add up, but for `least_m2`.
struct VarianceTerms {
  double constant_m2;      ///< squared constant standard deviation
  double relative2;        ///< squared standard deviation per range
  double relative_from_m;  ///< 0: both act; > 0: the constant one below this range, the relative one beyond
  double rounding_m2;
  double bearing_rad2;
  double least_m2;  ///< smallest variance
};

/// Directions and ranges of readings: `count` of them, followed by copies of the last one up to a multiple of
/// kBeamLanes. A direction is a unit vector (x, y) in any frame.
struct BeamArrays {
  const double* x;
  const double* y;
  const double* range;
  int count;
};

/// Sums over readings, with directions d and weights w that convert a squared error of the inverse range into one in
/// standard deviations: of w d d', of w d times an error of the inverse range, and the least inverse range.
struct BeamSums {
  double xx, xy, yy;
  double x, y;
  double least_inverse_range;
};

struct BeamKernels {
  /// Errors are inverse ranges of readings themselves; weights are those of walls at the readings that face the sensor.
  BeamSums (*linear)(const BeamArrays& readings, const VarianceTerms& variance);
  /// Errors are those of the line theta . d = inverse range to first order, (r - range) / r^2; weights are those of the
  /// line.
  BeamSums (*step)(const BeamArrays& readings, const double theta[2], const VarianceTerms& variance);
};

namespace baseline {
extern const BeamKernels kBeamKernels;
}
namespace v3 {
extern const BeamKernels kBeamKernels;
}

}  // namespace scanbench::extract
