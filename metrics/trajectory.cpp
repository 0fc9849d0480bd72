// trajectory: how far an estimated trajectory is from the true one.
//
// Absolute errors (ATE) after one motion of the plane, which the headings help to find: a straight path leaves its
// rotation about itself to them. Relative errors (RPE) between poses some frames or some metres of path apart, which
// need no alignment. Translation and rotation apart throughout: their ratio depends on the size of the world. After
// Sturm et al., "A benchmark for the evaluation of RGB-D SLAM systems", IROS 2012, in the plane.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/registry.hpp"
#include "metrics/plane_alignment.hpp"
#include "metrics/pose_errors.hpp"
#include "metrics/rows.hpp"

namespace scanbench::metrics {
namespace {

/// Root mean square, mean and maximum of |errors|.
struct Sizes {
  Mean squares, sizes;
  double largest = kUndefined;
  void add(double error) {
    const double size = std::fabs(error);
    squares.add(size * size);
    sizes.add(size);
    largest = std::isnan(largest) ? size : std::max(largest, size);
  }
};

class Trajectory : public MetricFamily {
 public:
  struct Params {
    double lever_m = 1.0;
    int step_frames = 1;
    double step_m = 1.0;
    static auto fields() {
      return std::tuple{
          field("lever_m", &Params::lever_m, above(0), "m", "metres of position that count as a radian of heading"),
          field("step_frames", &Params::step_frames, between(1, 1e6), "", "frames between the poses of RPE"),
          field("step_m", &Params::step_m, above(0), "m", "metres of true path between the poses of RPE per path")};
    }
  };
  explicit Trajectory(const Params& params) : params_(params) {}

  std::vector<MetricDescription> describe() const override {
    using enum Direction;
    return {{"ate_position", "m", lower_is_better, 0.001, "root mean square distance of aligned from true positions"},
            {"ate_position_mean", "m", lower_is_better, 0.001, "mean of that distance"},
            {"ate_position_max", "m", lower_is_better, 0.001, "largest of that distance"},
            {"ate_heading", "deg", lower_is_better, 0.01, "root mean square error of aligned headings"},
            {"ate_heading_mean", "deg", lower_is_better, 0.01, "mean size of that error"},
            {"ate_heading_max", "deg", lower_is_better, 0.01, "largest size of that error"},
            {"rpe_position", "m", lower_is_better, 0.001,
             "root mean square error of the shift between poses step_frames apart"},
            {"rpe_heading", "deg", lower_is_better, 0.01, "the same of the turn"},
            {"rpe_path_position", "m", lower_is_better, 0.001,
             "root mean square error of the shift between poses step_m of path apart"},
            {"rpe_path_heading", "deg", lower_is_better, 0.01, "the same of the turn"}};
  }

  bool applies(const MetricInput& input) const override {
    return input.truth != nullptr && !input.result.world_from_sensor.empty() &&
           input.result.world_from_sensor.size() == input.truth->world_from_sensor.size();
  }

  std::vector<MetricRow> evaluate(const MetricInput& input) const override {
    SCANBENCH_ASSERT(applies(input));
    const std::vector<Pose2>& estimated = input.result.world_from_sensor;
    const std::vector<Pose2>& truth = input.truth->world_from_sensor;
    Rows rows(describe());
    const Pose2 aligned_from_estimated = align_trajectories(estimated, truth, params_.lever_m);
    Sizes position, heading;
    for (std::size_t k = 0; k < truth.size(); ++k) {
      const Eigen::Vector3d e = pose_error(aligned_from_estimated * estimated[k], truth[k]);
      position.add(e.head<2>().norm());
      heading.add(degrees(e.z()));
    }
    for (const auto& [name, sizes] : {std::pair("ate_position", &position), std::pair("ate_heading", &heading)}) {
      rows.add(name, kAll, sizes->squares.root(), sizes->squares.count());
      rows.add(std::string(name) + "_mean", kAll, sizes->sizes);
      rows.add(std::string(name) + "_max", kAll, sizes->largest, sizes->sizes.count());
    }

    const auto step = static_cast<std::size_t>(params_.step_frames);
    const auto relative = [&](const std::string& prefix, const auto& partner_of) {
      Sizes shift, turn;
      for (std::size_t k = 0; k < truth.size(); ++k) {
        const std::size_t j = partner_of(k);
        if (j >= truth.size()) break;
        const Eigen::Vector3d e = pose_error(estimated[k].inverse() * estimated[j], truth[k].inverse() * truth[j]);
        shift.add(e.head<2>().norm());
        turn.add(degrees(e.z()));
      }
      rows.add(prefix + "_position", kAll, shift.squares.root(), shift.squares.count());
      rows.add(prefix + "_heading", kAll, turn.squares.root(), turn.squares.count());
    };
    relative("rpe", [&](std::size_t k) { return k + step; });
    std::vector<double> path(truth.size(), 0.0);
    for (std::size_t k = 1; k < truth.size(); ++k)
      path[k] = path[k - 1] + (truth[k].translation() - truth[k - 1].translation()).norm();
    relative("rpe_path", [&](std::size_t k) {
      return static_cast<std::size_t>(std::ranges::lower_bound(path, path[k] + params_.step_m) - path.begin());
    });
    return rows.take();
  }

 private:
  Params params_;
};

const bool registered = Registry<MetricFamily>::add<Trajectory>(
    {.name = "trajectory",
     .summary = "absolute and relative errors of estimated poses, translation and rotation apart",
     .reference = "Sturm et al. 2012, A benchmark for the evaluation of RGB-D SLAM systems, IROS"});

}  // namespace
}  // namespace scanbench::metrics
