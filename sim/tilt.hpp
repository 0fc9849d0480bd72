// Tilt of a sensor that is not level, for example one carried by hand: roll and pitch of its scanning plane (Lakaemper
// 2009, section V.B: "error-prone pitch, roll and yaw of the laser"; the yaw's error is OdometryNoise's).
//
// Frames: x forward, y left, z up; walls and round bodies are vertical and have no upper end. A positive pitch lowers
// the nose, a positive roll lifts the left side; the plane is rolled first, then pitched: Ry(pitch) Rx(roll).
#pragma once

#include <cstdint>

#include "core/geometry/geometry.hpp"
#include "core/params.hpp"

namespace scanbench::sim {

/// Standard deviations of the two angles, which are normal, independent of each other and from scan to scan, and
/// constant within a scan.
struct Tilt {
  double roll_sigma_rad = 0.0;
  double pitch_sigma_rad = 0.0;
  double height_m = 0.0;  ///< of the sensor over the floor, which tilted beams may hit; 0: there is no floor

  static auto fields() {
    using P = Tilt;
    return std::tuple{degrees_field("roll_sigma_deg", &P::roll_sigma_rad, between(0, 30),
                                    "standard deviation of the roll, independent per scan"),
                      degrees_field("pitch_sigma_deg", &P::pitch_sigma_rad, between(0, 30),
                                    "standard deviation of the pitch, independent per scan"),
                      field("height_m", &P::height_m, at_least(0), "m",
                            "height of the sensor over the floor, which tilted beams may hit; 0 removes the floor")};
  }
  bool level() const { return !(roll_sigma_rad > 0 || pitch_sigma_rad > 0); }
};

struct TiltAngles {
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
};

/// The angles of a scan. Enabling one of them does not change the other.
TiltAngles tilt_angles(const Tilt& tilt, std::uint64_t seed, std::uint32_t frame);

/// Direction of a beam of a tilted sensor. Seen from above it is a beam of a level sensor, rotated, with shorter
/// ranges.
struct TiltedBeam {
  Vec2 turn{1.0, 0.0};      ///< cos and sin of the rotation, seen from above, relative to a level sensor
  double horizontal = 1.0;  ///< horizontal distance per unit of beam length; always > 0
  double up = 0.0;          ///< rise per unit of beam length

  /// The range along the beam of a range seen from above.
  double range(double horizontal_range_m) const { return horizontal_range_m / horizontal; }
  /// Range to a floor `height_m` below the sensor; +inf for a beam that does not descend, and for height 0: no floor.
  double range_to_floor(double height_m) const;
};

/// The rotation of one scan, computed once for all of its beams.
class TiltRotation {
 public:
  explicit TiltRotation(const TiltAngles& angles);
  /// `direction`: unit vector in the sensor's frame.
  TiltedBeam beam(const Vec2& direction) const;

 private:
  double sin_roll_, cos_roll_, sin_pitch_, cos_pitch_;
};

}  // namespace scanbench::sim
