// Noise model of a range sensor. Each part has its own random numbers, addressed by (seed, frame, beam): they are the
// same for any number of threads, and enabling one part does not change the others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/geometry.hpp"
#include "core/isa.hpp"
#include "core/sensor_model.hpp"

namespace scanbench::sim {

struct DrawKernels;
struct ReadingKernels;

/// Address of one reading: its recording, frame and beam.
struct BeamAddress {
  std::uint64_t seed = 1;
  std::uint32_t frame = 0;
  std::uint32_t beam = 0;
};

/// The vector v rotated by an angle.
Vec2 rotated(const Vec2& v, double angle_rad);

/// Angle from a beam's nominal direction to its true one. 0 without bearing noise.
double bearing_error(const SensorNoise& noise, const BeamAddress& address);

/// The range that a beam of finite width returns at a depth edge, where its two sides hit different surfaces whose
/// ranges differ by more than the width of the beam. Uniform between the two ranges, because the edge may be anywhere
/// in the beam.
double mixed_range(double range_a_m, double range_b_m, const BeamAddress& address);

/// The reading of a beam that hits a surface at `true_range_m` (finite or +inf, never negative) under an angle
/// with cosine `cos_incidence` to its normal. `loss` is the surface's own (World::losses). In this order:
///   nothing within range_max: +inf, no noise; closer than range_min: -inf;
///   drop-out, with probability min(1, dropout_probability + dropout_grazing (1 - cos)^2 + loss): +inf;
///   short return, with spurious_probability: the range becomes uniform between range_min and the true one;
///   gaussian error with SensorNoise::gaussian_sigma of that range; rounding to multiples of the quantum;
///   a reading below range_min or not positive: -inf, above range_max: +inf (REP-117).
double observed_range(const SensorModel& sensor, double true_range_m, double cos_incidence, const BeamAddress& address,
                      double loss = 0.0);

/// The same for whole scans: the random numbers of all beams are drawn at once. The readings are equal to the bit.
class ScanNoise {
 public:
  /// `sensor` must outlive this. `isa` is for tests.
  ScanNoise(const SensorModel& sensor, std::uint64_t seed, Isa isa = best_isa());

  /// True if readings depend on the angle of incidence.
  static bool needs_incidence(const SensorNoise& noise);

  /// bearing_error() of every beam of a frame; empty without bearing noise. Valid until the next call.
  std::span<const double> bearing_errors(std::uint32_t frame, std::size_t beams);

  /// observed_range() of every beam of a frame. `cos_incidence` may be empty if needs_incidence() is false, `losses` if
  /// no surface has one.
  void observe(std::uint32_t frame, std::span<const double> true_ranges, std::span<const double> cos_incidence,
               std::span<double> readings, std::span<const double> losses = {});

 private:
  /// Lists the beams that return something in `beams_`, padded, and returns their number.
  std::size_t list_returns(std::span<const double> true_ranges);
  bool is_gaussian_alone(std::span<const double> losses) const;
  /// Draws the normals of the listed beams.
  void draw_normals(std::uint32_t frame);
  void observe_gaussian(std::uint32_t frame, std::span<const double> true_ranges, std::span<double> readings);

  const SensorModel& sensor_;
  std::uint64_t seed_;
  const DrawKernels& kernels_;
  const ReadingKernels& reading_kernels_;
  std::vector<std::uint32_t> beams_;
  std::vector<double> normals_, dropouts_, bearings_;
};

}  // namespace scanbench::sim
