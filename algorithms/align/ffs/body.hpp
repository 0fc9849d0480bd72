// A scan as a rigid body of force field simulation. Its lines are resampled at equal distances (Lakaemper 2010, section
// 4).
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"

namespace scanbench::align::ffs {

/// Sensor frame. Every point has mass 1 (section 3: "a constant mass to all data points").
struct Body {
  std::vector<Segment> lines;
  std::vector<Vec2> points;      ///< equidistant along the lines, including their end points
  std::vector<Vec2> directions;  ///< unit direction of the line of each point
  Vec2 centre = Vec2::Zero();    ///< centre of mass
  double inertia = 0.0;          ///< sum of squared distances from the centre [m^2]
  double radius = 0.0;           ///< largest distance from the centre

  double mass() const { return static_cast<double>(points.size()); }
};

/// Points along a segment, including both ends, at the largest equal distance that is at most `step_m` > 0. There are
/// at most 4096 points, so a line of any length is accepted.
void resample(const Segment& line, double step_m, std::vector<Vec2>& points);

/// Skips lines that are not finite, have no length or are more than 1e6 m from the sensor. A scan without lines is a
/// body without points, on which no forces act.
Body body_of(const Observation& observation, double step_m);

}  // namespace scanbench::align::ffs
