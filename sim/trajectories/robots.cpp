// Several robots at rest in the world, one scan each, as in Lakaemper, "Augmenting Sparse Laser Scans with Virtual
// Scans to Improve the Performance of Alignment Algorithms", 2010.
#include <tuple>
#include <utility>

#include "core/params.hpp"
#include "core/registry.hpp"
#include "sim/trajectories/common.hpp"

namespace scanbench::sim {
namespace {

class Robots : public TrajectoryKind {
 public:
  struct Params {
    NumberRows robots;
    static auto fields() {
      return std::tuple{field("robots", &Params::robots, any_number(), "m, m, deg",
                              "rows [x, y, heading_deg], one per robot; each takes one scan")};
    }
  };

  explicit Robots(Params params) : params_(std::move(params)) {}

  Trajectory generate(double scan_period_s) const override {
    Trajectory trajectory = poses_from_rows("robots", params_.robots, scan_period_s);
    trajectory.continuous = false;
    return trajectory;
  }

 private:
  Params params_;
};

SCANBENCH_REGISTER(TrajectoryKind, Robots,
                   {.name = "robots",
                    .summary = "robots placed in the world, one scan each; nothing moves between them",
                    .reference = "Lakaemper, \"Augmenting Sparse Laser Scans with Virtual Scans\", 2010, section 6"});

}  // namespace
}  // namespace scanbench::sim
