// Trajectory of a sensor that is carried along a line, stops every step and takes scans at the same headings at each
// stop.
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/geometry/angles.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/portable_math.hpp"
#include "core/number_text.hpp"
#include "core/registry.hpp"
#include "sim/trajectories/common.hpp"

namespace scanbench::sim {
namespace {

class StepAndShoot : public TrajectoryKind {
 public:
  struct Params {
    std::vector<double> start_m{0.0, 0.0};
    double direction_deg = 0.0;
    double step_m = 1.0;
    std::int64_t stops = 2;
    std::vector<double> headings_deg{0.0};
    static auto fields() {
      return std::tuple{
          field("start_m", &Params::start_m, any_number(), "m", "the first stop, [x, y]"),
          field("direction_deg", &Params::direction_deg, between(-360, 360), "deg", "direction of the steps"),
          field("step_m", &Params::step_m, above(0), "m", "distance from stop to stop"),
          field("stops", &Params::stops, between(1, kMaxScans), "", "number of stops"),
          field("headings_deg", &Params::headings_deg, between(-360, 360), "deg",
                "heading of each scan at a stop relative to the direction of the steps")};
    }
  };

  explicit StepAndShoot(Params params) : params_(std::move(params)), start_(point_param("start_m", params_.start_m)) {}

  Trajectory generate(double scan_period_s) const override {
    if (params_.headings_deg.empty())
      throw ParamError("headings_deg", "headings_deg is empty; each stop needs at least one heading");
    if (static_cast<double>(params_.stops) * static_cast<double>(params_.headings_deg.size()) > kMaxScans)
      throw ParamError("stops", "stops times headings_deg makes more than " + number_text(kMaxScans) + " scans");
    const auto [s, c] = portable::sincos(radians(params_.direction_deg));
    const Vec2 direction(c, s);
    Trajectory trajectory;
    trajectory.stops = true;
    for (std::int64_t k = 0; k < params_.stops; ++k) {
      const Vec2 stop = start_ + static_cast<double>(k) * params_.step_m * direction;
      for (const double heading : params_.headings_deg)
        append(trajectory, looking(stop, direction, heading), scan_period_s);
    }
    return trajectory;
  }

 private:
  Params params_;
  Vec2 start_;
};

SCANBENCH_REGISTER(
    TrajectoryKind, StepAndShoot,
    {.name = "step_and_shoot",
     .summary = "stops at equal steps along a line, a scan at each of some headings per stop",
     .reference = "Lakaemper, \"Simultaneous Multi-Line-Segment Merging for Robot Mapping using Mean Shift "
                  "Clustering\", 2009, section V.B"});

}  // namespace
}  // namespace scanbench::sim
