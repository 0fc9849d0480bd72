// The beams that a wall covers, and its inverse range along them, for several walls at once.
#pragma once

#include "core/lanes/lanes.hpp"
#include "sim/cast/beam_fan.hpp"
#include "sim/cast/wall_view.hpp"
#include "sim/lanes/angles.hpp"
#include "sim/wall_range.hpp"

namespace scanbench::sim::SCANBENCH_ISA {

/// Beam numbers as linear functions of angles.
struct BeamScale {
  double start;  ///< angle of beam 0
  double beams_per_rad;
  double period;  ///< beams of a full turn
  double margin;  ///< additional beams on either side that may be covered because of errors
  int beams;

  explicit BeamScale(const BeamFan& fan)
      : start(fan.start_rad),
        beams_per_rad(1.0 / fan.step_rad),
        period(2 * kPiHere * (beams_per_rad < 0 ? -beams_per_rad : beams_per_rad)),
        margin((fan.slack_rad + kAngleError) * (period / (2 * kPiHere))),
        beams(fan.beams) {}

  /// The first covered beam of an arc that begins at the angle `low` and ends at `high`, within two periods of 0.
  Doubles from(Doubles low, Doubles high) const {
    const Doubles begin = beams_per_rad > 0 ? low : high;
    return wrapped(begin - start) * beams_per_rad - margin;
  }
  Doubles width(Doubles arc) const { return arc * (beams_per_rad > 0 ? beams_per_rad : -beams_per_rad) + 2 * margin; }
};

/// The two runs of beam_runs() for several arcs, without a branch: beams first .. last and 0 .. last_behind.
struct LaneRuns {
  int first[kLanes], last[kLanes], last_behind[kLanes];

  BeamRun run(int lane) const { return {first[lane], last[lane]}; }
  BeamRun run_behind(int lane) const { return {0, last_behind[lane]}; }
  bool is_empty(int lane) const { return last[lane] < first[lane] && last_behind[lane] < 0; }
};

inline LaneRuns lane_runs(Doubles from, Doubles width, const BeamScale& scale) {
  const double last_beam = scale.beams - 1;
  const Longs once_around = ~(width < scale.period);
  from = from < 0.0 ? from + scale.period : from;
  from = from < 0.0 ? from + scale.period : from;
  const Doubles to = from + width;
  const Doubles nearest = (from + 0x1p52) - 0x1p52;
  const Doubles from_up = nearest < from ? nearest + 1.0 : nearest;
  const Longs is_one = once_around | (to < scale.period);
  LaneRuns runs{};
  store_whole(runs.first, once_around ? all(0.0) : from_up);
  store_whole(runs.last, once_around ? all(last_beam) : min(to, all(last_beam)));
  store_whole(runs.last_behind, is_one ? all(-1.0) : min(to - scale.period, all(last_beam)));
  return runs;
}

/// kLanes walls as a sensor sees them.
struct WallRuns {
  Doubles ax, ay, bx, by;  ///< ends relative to the sensor
  Doubles from, width;     ///< beams, for LaneRuns
  Doubles ux, uy, rise;    ///< along d the inverse range is at most ux dx + uy dy + rise
};

inline WallRuns wall_runs(const WallView& walls, int first, const BeamFan& fan, const BeamScale& scale) {
  constexpr double kAlmostAround = 3.13;  // rad: the sensor is nearly on the wall, which covers any direction
  constexpr double kNearM = 1e-3;         // the angle of a nearer end is not reliable
  constexpr double kTouchM = 1e-9;        // more than kEndToleranceM
  constexpr double kRounding = 64 * 0x1p-52;
  WallRuns w;  // NOLINT(*-member-init): every value is set below
  w.ax = load(walls.ax + first) - fan.origin_x;
  w.ay = load(walls.ay + first) - fan.origin_y;
  w.bx = load(walls.bx + first) - fan.origin_x;
  w.by = load(walls.by + first) - fan.origin_y;
  const Doubles angle_a = atan2_near(w.ay, w.ax);
  const Doubles angle_b = atan2_near(w.by, w.bx);
  const Doubles turn = wrapped(angle_b - angle_a);
  const Doubles arc = abs(turn);
  const Longs backwards = turn < 0.0;
  w.from = scale.from(backwards ? angle_b : angle_a, backwards ? angle_a : angle_b);
  const Doubles size_a = abs(w.ax) + abs(w.ay);
  const Doubles size_b = abs(w.bx) + abs(w.by);
  const Longs near = min(size_a, size_b) < kNearM;
  w.width = ((arc > kAlmostAround) | near) ? all(1e9) : scale.width(arc);
  const Doubles ex = w.bx - w.ax;
  const Doubles ey = w.by - w.ay;
  const Doubles twice_area = w.ax * ey - w.ay * ex;
  const Doubles inverse = 1.0 / twice_area;
  const Doubles a = ey * inverse;
  const Doubles b = -ex * inverse;
  // The exact range errs relative to 1/r by about eps |a| / p for a wall whose line passes at p = 1 / |(a, b)|. A beam
  // that passes an end within the tolerance hits the end, not the line, which adds an error of up to tolerance / p.
  const Doubles slope = abs(a) + abs(b);
  const Doubles steepness = kRounding * slope;
  const Doubles relative = (kRounding * (size_a + size_b) + 4 * kEndToleranceM) * slope;
  // The bound cannot be used for walls seen edge-on, where p is 0, and for walls that the sensor touches, which are hit
  // on both sides.
  const Longs touched = near | (abs(twice_area) < kTouchM * (abs(ex) + abs(ey)));
  const Longs usable = (relative < 1e-3) & ~touched;
  w.ux = usable ? a + a * relative : all(0.0);
  w.uy = usable ? b + b * relative : all(0.0);
  w.rise = usable ? steepness : all(1e300);
  return w;
}

}  // namespace scanbench::sim::SCANBENCH_ISA
