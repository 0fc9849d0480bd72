// Real beams, which are tilted, deflected and of finite width. They determine the readings, not the truth.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/geometry.hpp"
#include "core/sensor_model.hpp"
#include "sim/cast/ray.hpp"
#include "sim/noise.hpp"
#include "sim/ray_caster.hpp"
#include "sim/tilt.hpp"
#include "sim/trajectory.hpp"

namespace scanbench::sim {

/// The nominal beams of a frame.
struct FrameBeams {
  std::uint32_t frame = 0;
  TimedPose start;            ///< of the first beam
  bool sweep = false;         ///< rays differ in origin and time, else all are those of `start`
  std::span<const Ray> rays;  ///< of a level sensor, one per beam
};

/// Scratch memory of one thread for the beams of one sensor.
class RealBeams {
 public:
  /// The references must outlive this.
  RealBeams(const RayCaster& caster, const SensorModel& sensor, const Tilt& tilt, std::uint64_t seed,
            std::int32_t floor_surface);

  /// False if all beams are the nominal ones.
  static bool needed(const SensorNoise& noise, const Tilt& tilt);

  /// Casts the beams: gives ranges along the beams and cosines of incidence. The floor is one more surface.
  /// `bearing_errors`: one per beam, or none for 0.
  void meet(const FrameBeams& beams, std::span<const double> bearing_errors, std::span<double> ranges,
            std::span<double> cos_incidence);

 private:
  struct Beam {
    Vec2 direction;  ///< world frame, of a level sensor
    Vec2 in_sensor;
  };
  struct Hits {
    std::vector<double> ranges, cos_incidence;
    std::vector<std::int32_t> surfaces;
    void resize(std::size_t n);
  };

  void deflect(std::span<const Beam> from, double angle_rad, std::vector<Beam>& to) const;
  void meet(const FrameBeams& frame, std::span<const Beam> beams, const TiltRotation* tilt, Hits& hits);
  void mix(std::uint32_t frame, Hits& hits) const;

  const RayCaster& caster_;
  const SensorModel& sensor_;
  const Tilt& tilt_;
  std::uint64_t seed_;
  std::int32_t floor_surface_;
  std::vector<Beam> beams_, side_beams_;
  std::vector<TiltedBeam> tilted_;
  std::vector<Vec2> directions_;
  Hits middle_, left_, right_;
};

}  // namespace scanbench::sim
