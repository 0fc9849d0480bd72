// trajectory: how far an estimated trajectory is from the true one, or from the reference poses of a recorded log.
//
// Absolute errors (ATE) after one motion of the plane. Positions and headings determine it together, a radian counting
// as lever_m metres, so that a straight path is aligned too; Sturm et al. align positions alone. Relative errors (RPE)
// between poses some frames or some metres of path apart need no alignment; those of the odometry are beside them.
// After Sturm et al., "A benchmark for the evaluation of RGB-D SLAM systems", IROS 2012, in the plane. Where a log has
// relations: mean and mean square deviation from them, after Kuemmerle et al., "On measuring the accuracy of SLAM
// algorithms", Autonomous Robots 27, 2009, section 3. Translation and rotation are separate throughout: their ratio
// depends on the size of the world.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/geometry/plane_alignment.hpp"
#include "core/geometry/pose_errors.hpp"
#include "core/index.hpp"
#include "core/registry.hpp"
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

/// Errors of poses in metres and degrees.
struct Deviations {
  Sizes shift, turn;
  void add(const Pose2& found, const Pose2& truth) {
    const Eigen::Vector3d e = pose_error(found, truth);
    shift.add(e.head<2>().norm());
    turn.add(degrees(e.z()));
  }
};

Deviations deviations(const std::vector<PoseRelation>& relations, const std::vector<Pose2>& poses) {
  Deviations result;
  for (const PoseRelation& relation : relations) {
    const Pose2 &first = poses.at(as_index(relation.first)), &second = poses.at(as_index(relation.second));
    result.add(first.inverse() * second, relation.first_from_second);
  }
  return result;
}

/// The truth of a simulation, or the reference poses of a log; empty if there are none.
const std::vector<Pose2>& true_poses(const MetricInput& input) {
  static const std::vector<Pose2> kNone;
  if (input.truth != nullptr) return input.truth->world_from_sensor;
  return input.reference != nullptr ? input.reference->world_from_sensor : kNone;
}

class Trajectory : public MetricFamily {
 public:
  struct Params {
    double lever_m = 1.0;
    int step_frames = 1;
    double step_m = 1.0;
    static auto fields() {
      return std::tuple{
          field("lever_m", &Params::lever_m, above(0), "m",
                "metres of position that count as a radian of heading in the alignment of ATE"),
          field("step_frames", &Params::step_frames, between(1, 1e6), "", "frames between the poses of RPE"),
          field("step_m", &Params::step_m, above(0), "m", "metres of true path between the poses of RPE per path")};
    }
  };
  explicit Trajectory(const Params& params) : params_(params) {}

  std::vector<MetricDescription> describe() const override {
    using enum Direction;
    return {
        {"ate_position", "ATE, position", "m", lower_is_better, 0.001,
         "root mean square distance of aligned positions from the true ones, or from a log's reference. One motion "
         "aligns positions and headings together, a radian counting as lever_m; Sturm et al. align positions alone"},
        {"ate_position_mean", "mean ATE, position", "m", lower_is_better, 0.001,
         "mean distance of aligned positions from the true ones, or from a log's reference"},
        {"ate_position_max", "largest ATE, position", "m", lower_is_better, 0.001,
         "largest distance of an aligned position from the true one, or from a log's reference"},
        {"ate_heading", "ATE, heading", "deg", lower_is_better, 0.01, "root mean square error of aligned headings"},
        {"ate_heading_mean", "mean ATE, heading", "deg", lower_is_better, 0.01,
         "mean absolute error of aligned headings"},
        {"ate_heading_max", "largest ATE, heading", "deg", lower_is_better, 0.01,
         "largest absolute error of an aligned heading"},
        {"rpe_position", "RPE, position", "m", lower_is_better, 0.001,
         "root mean square error of the shift between poses step_frames apart (1: consecutive scans)"},
        {"rpe_heading", "RPE, heading", "deg", lower_is_better, 0.01,
         "root mean square error of the turn between poses step_frames apart (1: consecutive scans)"},
        {"rpe_path_position", "RPE over path, position", "m", lower_is_better, 0.001,
         "root mean square error of the shift between poses step_m of path apart"},
        {"rpe_path_heading", "RPE over path, heading", "deg", lower_is_better, 0.01,
         "root mean square error of the turn between poses step_m of path apart"},
        {"ate_odometry_position", "odometry ATE, position", "m", neither, 0.0, "ate_position of the odometry"},
        {"ate_odometry_heading", "odometry ATE, heading", "deg", neither, 0.0, "ate_heading of the odometry"},
        {"rpe_odometry_position", "odometry RPE, position", "m", neither, 0.0, "rpe_position of the odometry"},
        {"rpe_odometry_heading", "odometry RPE, heading", "deg", neither, 0.0, "rpe_heading of the odometry"},
        {"relations_position", "relations error, position", "m", lower_is_better, 0.001,
         "mean deviation of the shift from a log's relations"},
        {"relations_position_square", "squared relations error, position", "m^2", lower_is_better, 0.001,
         "mean square deviation of the shift from a log's relations"},
        {"relations_heading", "relations error, heading", "deg", lower_is_better, 0.01,
         "mean deviation of the turn from a log's relations"},
        {"relations_heading_square", "squared relations error, heading", "deg^2", lower_is_better, 0.01,
         "mean square deviation of the turn from a log's relations"},
        {"relations_odometry_position", "odometry relations error, position", "m", neither, 0.0,
         "relations_position of the odometry"},
        {"relations_odometry_heading", "odometry relations error, heading", "deg", neither, 0.0,
         "relations_heading of the odometry"}};
  }

  bool applies(const MetricInput& input) const override {
    const std::vector<Pose2>& estimated = input.result.world_from_sensor;
    return !estimated.empty() && ((input.reference != nullptr && !input.reference->relations.empty()) ||
                                  estimated.size() == true_poses(input).size());
  }

  std::vector<MetricRow> evaluate(const MetricInput& input) const override {
    SCANBENCH_ASSERT(applies(input));
    const std::vector<Pose2>& estimated = input.result.world_from_sensor;
    std::vector<Pose2> odometry;
    for (const Frame& frame : input.observed.frames) odometry.push_back(frame.odom_from_sensor);
    const bool comparable = odometry.size() == estimated.size();
    Rows rows(describe());
    if (const std::vector<Pose2>& truth = true_poses(input); truth.size() == estimated.size()) {
      add_absolute(rows, estimated, truth);
      const auto step = static_cast<std::size_t>(params_.step_frames);
      const auto frames_ahead = [&](std::size_t k) { return k + step; };
      add_relative(rows, "rpe", estimated, truth, frames_ahead);
      std::vector<double> path(truth.size(), 0.0);
      for (std::size_t k = 1; k < truth.size(); ++k)
        path[k] = path[k - 1] + (truth[k].translation() - truth[k - 1].translation()).norm();
      add_relative(rows, "rpe_path", estimated, truth, [&](std::size_t k) {
        return static_cast<std::size_t>(std::ranges::lower_bound(path, path[k] + params_.step_m) - path.begin());
      });
      if (comparable) {
        const Deviations absolute = absolute_errors(odometry, truth);
        rows.add("ate_odometry_position", kAll, absolute.shift.squares.root(), absolute.shift.squares.count());
        rows.add("ate_odometry_heading", kAll, absolute.turn.squares.root(), absolute.turn.squares.count());
        add_relative(rows, "rpe_odometry", odometry, truth, frames_ahead);
      }
    }
    if (input.reference == nullptr || input.reference->relations.empty()) return rows.take();
    const Deviations of_estimate = deviations(input.reference->relations, estimated);
    for (const auto& [name, sizes] :
         {std::pair("relations_position", &of_estimate.shift), std::pair("relations_heading", &of_estimate.turn)}) {
      rows.add(name, kAll, sizes->sizes);
      rows.add(std::string(name) + "_square", kAll, sizes->squares);
    }
    if (comparable) {
      const Deviations of_odometry = deviations(input.reference->relations, odometry);
      rows.add("relations_odometry_position", kAll, of_odometry.shift.sizes);
      rows.add("relations_odometry_heading", kAll, of_odometry.turn.sizes);
    }
    return rows.take();
  }

 private:
  Deviations absolute_errors(const std::vector<Pose2>& estimated, const std::vector<Pose2>& truth) const {
    const Pose2 aligned_from_estimated = align_trajectories(estimated, truth, params_.lever_m);
    Deviations errors;
    for (std::size_t k = 0; k < truth.size(); ++k) errors.add(aligned_from_estimated * estimated[k], truth[k]);
    return errors;
  }

  void add_absolute(Rows& rows, const std::vector<Pose2>& estimated, const std::vector<Pose2>& truth) const {
    const Deviations errors = absolute_errors(estimated, truth);
    for (const auto& [name, sizes] :
         {std::pair("ate_position", &errors.shift), std::pair("ate_heading", &errors.turn)}) {
      rows.add(name, kAll, sizes->squares.root(), sizes->squares.count());
      rows.add(std::string(name) + "_mean", kAll, sizes->sizes);
      rows.add(std::string(name) + "_max", kAll, sizes->largest, sizes->sizes.count());
    }
  }

  /// Between each pose and the one whose index is partner_of(index), as long as there is one.
  template <class PartnerOf>
  static void add_relative(Rows& rows, const std::string& prefix, const std::vector<Pose2>& estimated,
                           const std::vector<Pose2>& truth, const PartnerOf& partner_of) {
    Deviations errors;
    for (std::size_t k = 0; k < truth.size(); ++k) {
      const std::size_t j = partner_of(k);
      if (j >= truth.size()) break;
      errors.add(estimated[k].inverse() * estimated[j], truth[k].inverse() * truth[j]);
    }
    rows.add(prefix + "_position", kAll, errors.shift.squares.root(), errors.shift.squares.count());
    rows.add(prefix + "_heading", kAll, errors.turn.squares.root(), errors.turn.squares.count());
  }

  Params params_;
};

SCANBENCH_REGISTER(
    MetricFamily, Trajectory,
    {.name = "trajectory",
     .summary = "absolute and relative errors of estimated poses, translation and rotation apart",
     .reference =
         "Sturm et al. 2012, A benchmark for the evaluation of RGB-D SLAM systems, IROS; Kuemmerle et al. 2009"});

}  // namespace
}  // namespace scanbench::metrics
