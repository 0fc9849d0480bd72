// Trajectory along straight pieces between named points, as A-B-C-D-E-F in Borges & Aldon, "A split-and-merge
// segmentation algorithm for line extraction in 2-D range images", ICPR 2000.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "core/params.hpp"
#include "core/registry.hpp"
#include "sim/path.hpp"
#include "sim/place_text.hpp"
#include "sim/trajectories/common.hpp"

namespace scanbench::sim {
namespace {

class Waypoints : public TrajectoryKind {
 public:
  struct Params {
    NamedPoints points_m;
    std::int64_t scans = 0;
    double speed_mps = 0.0;
    double heading_offset_deg = 0.0;
    static auto fields() {
      return std::tuple{
          field("points_m", &Params::points_m, any_number(), "m", "corners of the path in order, {A: [x, y], ...}"),
          field("scans", &Params::scans, between(0, kMaxScans), "",
                "number of scans, at the middle of as many equal intervals of the path's length; 0 if speed_mps is "
                "given"),
          field("speed_mps", &Params::speed_mps, at_least(0), "m/s",
                "speed; a scan is taken at the start and every scan period from then on; 0 if scans is given"),
          field("heading_offset_deg", &Params::heading_offset_deg, between(-360, 360), "deg",
                "heading of the sensor relative to the direction of travel")};
    }
  };

  explicit Waypoints(Params params) : params_(std::move(params)) {}

  Trajectory generate(double scan_period_s) const override {
    const auto& points = params_.points_m;
    if (points.size() < 2)
      throw ParamError("points_m",
                       "points_m has " + std::to_string(points.size()) + " points; a path needs at least two");
    if ((params_.scans > 0) == (params_.speed_mps > 0))
      throw ParamError("scans", params_.scans > 0 ? "scans and speed_mps are both given; allowed: one of them"
                                                  : "neither scans nor speed_mps is given; one of them must be > 0");
    Trajectory trajectory;
    trajectory.waypoints = points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i > 0 && points[i].second == points[i - 1].second)
        throw ParamError("points_m", "points_m: " + points[i - 1].first + " and " + points[i].first + " are both at " +
                                         place_text(points[i].second) + "; neighbours must differ");
      trajectory.path.push_back(points[i].second);
    }
    const double length = path_length(trajectory.path);
    if (params_.scans > 0) {
      const double interval = length / static_cast<double>(params_.scans);
      for (std::int64_t k = 0; k < params_.scans; ++k)
        add(trajectory, (static_cast<double>(k) + 0.5) * interval, scan_period_s);
    } else {
      const double spacing = params_.speed_mps * scan_period_s;
      const double count = std::floor(length / spacing) + 1.0;
      if (!(count <= kMaxScans))
        throw ParamError("speed_mps",
                         "speed_mps makes " + number_text(count) + " scans; allowed: up to " + number_text(kMaxScans));
      for (std::int64_t k = 0; k < static_cast<std::int64_t>(count); ++k)
        add(trajectory, static_cast<double>(k) * spacing, scan_period_s);
    }
    return trajectory;
  }

 private:
  void add(Trajectory& trajectory, double arc_length_m, double scan_period_s) const {
    const PathPoint at = point_on_path(trajectory.path, arc_length_m);
    append(trajectory, looking(at.position, at.direction, params_.heading_offset_deg), scan_period_s);
  }

  Params params_;
};

SCANBENCH_REGISTER(TrajectoryKind, Waypoints,
                   {.name = "waypoints",
                    .summary = "drive along straight pieces between named points, looking ahead",
                    .reference = "Borges & Aldon, ICPR 2000, section 4"});

}  // namespace
}  // namespace scanbench::sim
