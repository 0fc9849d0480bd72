// Trajectory of poses listed one by one.
#include <tuple>
#include <utility>

#include "core/params.hpp"
#include "core/registry.hpp"
#include "sim/trajectories/common.hpp"

namespace scanbench::sim {
namespace {

class Poses : public TrajectoryKind {
 public:
  struct Params {
    NumberRows poses;
    bool continuous = true;
    static auto fields() {
      return std::tuple{
          field("poses", &Params::poses, any_number(), "m, m, deg", "rows [x, y, heading_deg], one per scan"),
          field("continuous", &Params::continuous,
                "true: the sensor moves straight from pose to pose (its path must be clear); false: it is placed at "
                "each pose")};
    }
  };

  explicit Poses(Params params) : params_(std::move(params)) {}

  Trajectory generate(double scan_period_s) const override {
    Trajectory trajectory = poses_from_rows("poses", params_.poses, scan_period_s);
    trajectory.continuous = params_.continuous;
    return trajectory;
  }

 private:
  Params params_;
};

SCANBENCH_REGISTER(TrajectoryKind, Poses,
                   {.name = "poses", .summary = "poses listed one by one, one scan period apart", .reference = ""});

}  // namespace
}  // namespace scanbench::sim
