// Casts the deflected, tilted and wide beams of a frame.
#include "sim/real_beams.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/geometry/geometry.hpp"
#include "core/geometry/portable_math.hpp"

namespace scanbench::sim {
namespace {

Vec2 rotated_by(const Vec2& v, const portable::SinCos& angle) {
  return {angle.cos * v.x() - angle.sin * v.y(), angle.sin * v.x() + angle.cos * v.y()};
}

}  // namespace

RealBeams::RealBeams(const RayCaster& caster, const SensorModel& sensor, const Tilt& tilt, std::uint64_t seed,
                     std::int32_t floor_surface)
    : caster_(caster), sensor_(sensor), tilt_(tilt), seed_(seed), floor_surface_(floor_surface) {}

bool RealBeams::needed(const SensorNoise& noise, const Tilt& tilt) {
  return !tilt.level() || noise.bearing_sigma_rad > 0 || noise.beam_divergence_rad > 0;
}

void RealBeams::Hits::resize(std::size_t n) {
  ranges.resize(n);
  cos_incidence.resize(n);
  surfaces.resize(n);
}

void RealBeams::meet(const FrameBeams& frame, std::span<const double> bearing_errors, std::span<double> ranges,
                     std::span<double> cos_incidence) {
  const std::size_t n = frame.rays.size();
  beams_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto error = portable::sincos(bearing_errors.empty() ? 0.0 : bearing_errors[i]);
    beams_[i] = {rotated_by(frame.rays[i].direction, error),
                 rotated_by(sensor_.geometry.direction(static_cast<int>(i)), error)};
  }
  std::optional<TiltRotation> tilt;
  if (!tilt_.level()) tilt.emplace(tilt_angles(tilt_, seed_, frame.frame));
  const TiltRotation* rotation = tilt ? &*tilt : nullptr;
  meet(frame, beams_, rotation, middle_);
  const double half_width = 0.5 * sensor_.noise.beam_divergence_rad;
  if (half_width > 0) {
    deflect(beams_, half_width, side_beams_);
    meet(frame, side_beams_, rotation, left_);
    deflect(beams_, -half_width, side_beams_);
    meet(frame, side_beams_, rotation, right_);
    mix(frame.frame, middle_);
  }
  std::ranges::copy(middle_.ranges, ranges.begin());
  std::ranges::copy(middle_.cos_incidence, cos_incidence.begin());
}

void RealBeams::deflect(std::span<const Beam> from, double angle_rad, std::vector<Beam>& to) const {
  const auto angle = portable::sincos(angle_rad);
  to.clear();
  for (const Beam& beam : from) to.push_back({rotated_by(beam.direction, angle), rotated_by(beam.in_sensor, angle)});
}

// Casts the beams as seen from above, then converts the ranges of a tilted sensor to ranges along the beams.
void RealBeams::meet(const FrameBeams& frame, std::span<const Beam> beams, const TiltRotation* tilt, Hits& hits) {
  const double range_max_m = sensor_.range_max_m;
  const std::size_t n = beams.size();
  tilted_.clear();
  directions_.clear();
  for (const Beam& beam : beams) {
    const TiltedBeam& tilted = tilted_.emplace_back(tilt != nullptr ? tilt->beam(beam.in_sensor) : TiltedBeam{});
    const Vec2& level = beam.direction;
    directions_.push_back(tilt == nullptr ? level
                                          : Vec2(tilted.turn.x() * level.x() - tilted.turn.y() * level.y(),
                                                 tilted.turn.y() * level.x() + tilted.turn.x() * level.y()));
  }
  hits.resize(n);
  if (frame.sweep) {
    for (std::size_t i = 0; i < n; ++i) {
      const Ray& ray = frame.rays[i];
      store_hit(caster_.cast({ray.origin, directions_[i], ray.time_s}, range_max_m), i,
                {hits.ranges, {}, hits.cos_incidence, hits.surfaces});
    }
  } else {
    caster_.cast_bent_scan({frame.start.world_from_sensor, frame.start.stamp_s, directions_}, sensor_.geometry,
                           range_max_m, {hits.ranges, {}, hits.cos_incidence, hits.surfaces});
  }
  if (tilt == nullptr) return;
  for (std::size_t i = 0; i < n; ++i) {
    const TiltedBeam& beam = tilted_[i];
    if (hits.ranges[i] > range_max_m * beam.horizontal) {
      hits.ranges[i] = std::numeric_limits<double>::infinity();
      hits.surfaces[i] = -1;
      hits.cos_incidence[i] = 0.0;
    }
    hits.ranges[i] = beam.range(hits.ranges[i]);
    hits.cos_incidence[i] *= beam.horizontal;
    const double floor_m = beam.range_to_floor(tilt_.height_m);
    if (!(floor_m < hits.ranges[i] && floor_m <= range_max_m)) continue;
    hits.ranges[i] = floor_m;
    hits.surfaces[i] = floor_surface_;
    hits.cos_incidence[i] = -beam.up;
  }
}

// Mixes ranges at depth edges, where the two sides of a beam hit surfaces whose ranges differ by more than the width of
// the beam. A smaller difference is a slanted corner.
void RealBeams::mix(std::uint32_t frame, Hits& hits) const {
  for (std::size_t i = 0; i < hits.ranges.size(); ++i) {
    const double left = left_.ranges[i];
    const double right = right_.ranges[i];
    const double width = sensor_.noise.beam_divergence_rad * std::min(left, right);
    if (hits.surfaces[i] >= 0 && left_.surfaces[i] >= 0 && right_.surfaces[i] >= 0 &&
        left_.surfaces[i] != right_.surfaces[i] && std::fabs(left - right) > width)
      hits.ranges[i] = mixed_range(left, right, {seed_, frame, static_cast<std::uint32_t>(i)});
  }
}

}  // namespace scanbench::sim
