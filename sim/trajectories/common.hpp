// Shared parts of the kinds of trajectory: checks of parameters, headings, time stamps.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/geometry/angles.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/pose2.hpp"
#include "core/number_text.hpp"
#include "core/params.hpp"
#include "sim/trajectory.hpp"

namespace scanbench::sim {

/// The largest number of scans of one trajectory.
inline constexpr double kMaxScans = 1e7;

/// A pose at p that looks along `direction` rotated by `offset_deg`; exact along `direction` for offset 0.
inline Pose2 looking(const Vec2& p, const Vec2& direction, double offset_deg) {
  if (offset_deg == 0) return Pose2::facing(p, direction);
  return Pose2::facing(p, Pose2(Vec2::Zero(), radians(offset_deg)).rotate(direction));
}

/// Adds a pose one scan period after the last.
inline void append(Trajectory& trajectory, const Pose2& pose, double scan_period_s) {
  trajectory.poses.push_back({static_cast<double>(trajectory.poses.size()) * scan_period_s, pose});
}

/// A point given as a list of two numbers; throws ParamError otherwise.
inline Vec2 point_param(const std::string& name, const std::vector<double>& xy) {
  if (xy.size() != 2)
    throw ParamError(name, name + " has " + std::to_string(xy.size()) + " numbers; allowed: two, [x, y]");
  return {xy[0], xy[1]};
}

/// Rows x, y, heading in degrees as poses, one scan period apart; throws ParamError if there is no row, or one without
/// three numbers.
inline Trajectory poses_from_rows(const std::string& name, const NumberRows& rows, double scan_period_s) {
  if (rows.empty()) throw ParamError(name, name + " is empty; it needs at least one row [x, y, heading_deg]");
  Trajectory trajectory;
  trajectory.poses.reserve(rows.size());
  for (const auto& row : rows) {
    if (row.size() != 3)
      throw ParamError(name, name + " row " + std::to_string(trajectory.poses.size() + 1) + " has " +
                                 std::to_string(row.size()) + " numbers; allowed: three, [x, y, heading_deg]");
    append(trajectory, Pose2(row[0], row[1], radians(row[2])), scan_period_s);
  }
  return trajectory;
}

}  // namespace scanbench::sim
