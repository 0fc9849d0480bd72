// The small sections of a scenario file as parameters: limits, odometry, tilt, the sensor beside a log.
#pragma once

#include <vector>

#include "core/params.hpp"
#include "sim/line_copies.hpp"
#include "sim/simulate.hpp"

namespace scanbench::harness {

struct LimitParams {
  double seconds = 600.0;
  double memory_mib = 4096.0;
  static auto fields() {
    return std::tuple{field("seconds", &LimitParams::seconds, above(0), "s", "wall time of a cell"),
                      field("memory_mib", &LimitParams::memory_mib, at_least(16), "MiB",
                            "memory of a cell, and of a recording before it starts")};
  }
};

/// sim::OdometryNoise in the units of the file.
struct OdometryParams {
  double translation_per_m = 0.0;
  double rotation_per_m_deg = 0.0;
  double rotation_per_rad = 0.0;
  double pose_position_sigma_m = 0.0;
  double pose_heading_sigma_deg = 0.0;
  static auto fields() {
    using P = OdometryParams;
    return std::tuple{field("translation_per_m", &P::translation_per_m, at_least(0), "m",
                            "standard deviation of the way after one metre, along the motion"),
                      field("rotation_per_m_deg", &P::rotation_per_m_deg, at_least(0), "deg",
                            "standard deviation of the heading after one metre"),
                      field("rotation_per_rad", &P::rotation_per_rad, at_least(0), "rad",
                            "standard deviation of the heading after turning by one radian"),
                      field("pose_position_sigma_m", &P::pose_position_sigma_m, at_least(0), "m",
                            "standard deviation of each coordinate, independent per pose"),
                      field("pose_heading_sigma_deg", &P::pose_heading_sigma_deg, at_least(0), "deg",
                            "standard deviation of the heading, independent per pose")};
  }
  sim::OdometryNoise noise() const {
    return {.translation_per_m = translation_per_m,
            .rotation_per_m_rad = radians(rotation_per_m_deg),
            .rotation_per_rad = rotation_per_rad,
            .pose_position_sigma_m = pose_position_sigma_m,
            .pose_heading_sigma_rad = radians(pose_heading_sigma_deg)};
  }
};

/// sim::Tilt in the units of the file.
struct TiltParams {
  double roll_sigma_deg = 0.0;
  double pitch_sigma_deg = 0.0;
  double height_m = 0.0;
  static auto fields() {
    using P = TiltParams;
    return std::tuple{field("roll_sigma_deg", &P::roll_sigma_deg, between(0, 30), "deg",
                            "standard deviation of the roll, independent per scan"),
                      field("pitch_sigma_deg", &P::pitch_sigma_deg, between(0, 30), "deg",
                            "standard deviation of the pitch, independent per scan"),
                      field("height_m", &P::height_m, at_least(0), "m",
                            "height of the sensor over the floor, which tilted beams may meet; 0: no floor")};
  }
  sim::Tilt tilt() const {
    return {
        .roll_sigma_rad = radians(roll_sigma_deg), .pitch_sigma_rad = radians(pitch_sigma_deg), .height_m = height_m};
  }
};

/// sim::LineCopies in the units of the file.
struct LineCopiesParams {
  std::int64_t copies = 10;
  double rotation_sigma_deg = 0.0;
  double shift_sigma_m = 0.0;
  static auto fields() {
    using P = LineCopiesParams;
    return std::tuple{field("copies", &P::copies, between(1, 10000), "", "how often every wall is there"),
                      field("rotation_sigma_deg", &P::rotation_sigma_deg, at_least(0), "deg",
                            "standard deviation of the turn of a copy about the world's origin"),
                      field("shift_sigma_m", &P::shift_sigma_m, at_least(0), "m",
                            "standard deviation of each coordinate of a copy's shift")};
  }
  sim::LineCopies copies_of() const {
    return {.copies = static_cast<int>(copies),
            .rotation_sigma_rad = radians(rotation_sigma_deg),
            .shift_sigma_m = shift_sigma_m};
  }
};

/// The fields of a sensor that a log does not state: noise and timing.
std::vector<ParamSpec> recorded_sensor_specs();

}  // namespace scanbench::harness
