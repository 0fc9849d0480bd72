// A scan as a rigid body of force field simulation: its lines resampled at equal distances (Lakaemper 2010, section 4).
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"

namespace scanbench::align::ffs {

/// Sensor frame. Every point has mass 1 (section 3: "a constant mass to all data points").
struct Body {
  std::vector<Segment> lines;
  std::vector<Vec2> points;      ///< equidistant along the lines, their end points included
  std::vector<Vec2> directions;  ///< per point, unit: that of its line
  Vec2 centre = Vec2::Zero();    ///< of mass
  double inertia = 0.0;          ///< sum of squared distances from the centre [m^2]
  double radius = 0.0;           ///< largest distance from the centre

  double mass() const { return static_cast<double>(points.size()); }
};

/// Points along a segment at the largest equal distance that is no more than `step_m` > 0, both ends included; at most
/// 4096, so that a line of any length has an answer.
void resample(const Segment& line, double step_m, std::vector<Vec2>& points);

/// Lines that are not finite, without length or beyond 1e6 m from the sensor are left out. A scan without lines is a
/// body without points: nothing attracts it.
Body body_of(const Observation& observation, double step_m);

}  // namespace scanbench::align::ffs
