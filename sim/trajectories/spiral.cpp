// Trajectory along an Archimedean spiral r = r0 + c * theta, scans at the middle of equal intervals of arc length.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/geometry/angles.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/portable_math.hpp"
#include "core/geometry/pose2.hpp"
#include "core/registry.hpp"
#include "sim/trajectories/common.hpp"

namespace scanbench::sim {
namespace {

class Spiral : public TrajectoryKind {
 public:
  struct Params {
    std::vector<double> center_m{0.0, 0.0};
    double inner_radius_m = 0.5;
    double outer_radius_m = 3.0;
    double turns = 3.0;
    double start_deg = 0.0;
    std::int64_t scans = 100;
    double heading_offset_deg = 0.0;
    static auto fields() {
      return std::tuple{
          field("center_m", &Params::center_m, any_number(), "m", "centre of the spiral, [x, y]"),
          field("inner_radius_m", &Params::inner_radius_m, at_least(0), "m", "radius at the start"),
          field("outer_radius_m", &Params::outer_radius_m, at_least(0), "m", "radius at the end"),
          field("turns", &Params::turns, between(-1000, 1000), "", "turns from start to end; negative: clockwise"),
          field("start_deg", &Params::start_deg, between(-360, 360), "deg", "direction of the start from the centre"),
          field("scans", &Params::scans, between(1, kMaxScans), "",
                "number of scans, at the middle of as many equal intervals of the path's length"),
          field("heading_offset_deg", &Params::heading_offset_deg, between(-360, 360), "deg",
                "heading of the sensor relative to the direction of travel")};
    }
  };

  explicit Spiral(Params params) : params_(std::move(params)), center_(point_param("center_m", params_.center_m)) {}

  Trajectory generate(double scan_period_s) const override {
    if (params_.turns == 0) throw ParamError("turns", "turns is 0; allowed: any other number from -1000 to 1000");
    if (params_.inner_radius_m == 0 && params_.outer_radius_m == 0)
      throw ParamError("outer_radius_m", "inner_radius_m and outer_radius_m are both 0; one must be > 0");
    // Arc length at the ends of equal intervals of theta, 1/720 turn or less each.
    const auto intervals = static_cast<std::size_t>(std::ceil(std::fabs(params_.turns) * 720.0));
    std::vector<double> length(intervals + 1, 0.0);
    const double step = 1.0 / static_cast<double>(intervals);
    for (std::size_t i = 0; i < intervals; ++i)
      length[i + 1] = length[i] + arc(static_cast<double>(i) * step, static_cast<double>(i + 1) * step);
    Trajectory trajectory;
    trajectory.poses.reserve(static_cast<std::size_t>(params_.scans));
    std::size_t i = 0;
    for (std::int64_t k = 0; k < params_.scans; ++k) {
      const double target = length.back() * (static_cast<double>(k) + 0.5) / static_cast<double>(params_.scans);
      while (i + 1 < intervals && length[i + 1] < target) ++i;
      append(trajectory, pose_at(parameter_at(static_cast<double>(i) * step, target - length[i], step)), scan_period_s);
    }
    return trajectory;
  }

 private:
  double radius(double u) const {
    return params_.inner_radius_m + u * (params_.outer_radius_m - params_.inner_radius_m);
  }
  double theta(double u) const { return radians(params_.start_deg) + u * params_.turns * kTwoPi; }

  // ds/du of x = r cos(theta), y = r sin(theta), u from 0 at the start to 1 at the end.
  double speed(double u) const {
    const double dr = params_.outer_radius_m - params_.inner_radius_m;
    const double rotation = radius(u) * params_.turns * kTwoPi;
    return std::sqrt(dr * dr + rotation * rotation);
  }

  // Arc length by Simpson's rule: the interval is short, the speed smooth.
  double arc(double u0, double u1) const {
    return (u1 - u0) / 6.0 * (speed(u0) + 4.0 * speed(0.5 * (u0 + u1)) + speed(u1));
  }

  // u with arc(u0, u) = s, by Newton's method; s is within one interval, where the speed is nearly constant.
  double parameter_at(double u0, double s, double step) const {
    double u = u0 + std::min(step, s / std::max(speed(u0 + 0.5 * step), 1e-12));
    for (int i = 0; i < 4; ++i) u -= (arc(u0, u) - s) / std::max(speed(u), 1e-12);
    return u;
  }

  Pose2 pose_at(double u) const {
    const auto [s, c] = portable::sincos(theta(u));
    const double dr = params_.outer_radius_m - params_.inner_radius_m;
    const double rotation = radius(u) * params_.turns * kTwoPi;
    const Vec2 tangent(dr * c - rotation * s, dr * s + rotation * c);
    return looking(center_ + radius(u) * Vec2(c, s), tangent, params_.heading_offset_deg);
  }

  Params params_;
  Vec2 center_;
};

SCANBENCH_REGISTER(
    TrajectoryKind, Spiral,
    {.name = "spiral",
     .summary = "drive along an Archimedean spiral, looking ahead",
     .reference = "Lakaemper, \"Simultaneous Multi-Line-Segment Merging for Robot Mapping using Mean Shift "
                  "Clustering\", 2009, figures 1-3 (the scene's shape)"});

}  // namespace
}  // namespace scanbench::sim
