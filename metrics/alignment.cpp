// alignment: errors of the poses that a pipeline used, and of those that it was given, after the motion that is common
// to all of them is removed. Only relative poses are observable: a map that is right but rotated has no error.
//
// The common motion G minimises the sum over scans of |G p - q|^2 + lever^2 |G h - g|^2, p and q being the estimated
// and the true position, h and g the unit headings: the squared distance of the pose and of a point `lever` ahead of
// it.
//
// Beside the errors is the least that they can be: the Cramer-Rao bound of the poses of all scans together, walls
// unknown, after the same motion is removed (joint_pose_bound.hpp). The errors that are compared with it are those of
// the scans that the data determine, after the common motion of these alone.
#include <algorithm>
#include <cmath>
#include <span>

#include "core/error.hpp"
#include "core/geometry/portable_math.hpp"
#include "core/registry.hpp"
#include "metrics/joint_pose_bound.hpp"
#include "metrics/rows.hpp"

namespace scanbench::metrics {
namespace {

struct PoseErrors {
  std::vector<double> position_m;
  std::vector<double> heading_deg;
};

/// Minimiser of the sum above, in closed form: the angle of the summed cross and dot products about the centroids.
Pose2 common_motion(std::span<const Pose2> estimated, std::span<const Pose2> truth, double lever_m) {
  const auto n = static_cast<double>(estimated.size());
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();
  for (std::size_t k = 0; k < estimated.size(); ++k) {
    from += estimated[k].translation() / n;
    to += truth[k].translation() / n;
  }
  double along = 0.0, across = 0.0;
  for (std::size_t k = 0; k < estimated.size(); ++k) {
    const Vec2 p = estimated[k].translation() - from, q = truth[k].translation() - to;
    const Vec2 h(estimated[k].cos(), estimated[k].sin()), g(truth[k].cos(), truth[k].sin());
    along += p.dot(q) + lever_m * lever_m * h.dot(g);
    across += cross(p, q) + lever_m * lever_m * cross(h, g);
  }
  if (along == 0 && across == 0) along = 1;
  const Pose2 turn = Pose2::facing(Vec2::Zero(), {along, across});
  return Pose2::facing(to - turn.rotate(from), {along, across});
}

/// Squared errors of some scans and their bounds.
struct JointEfficiency {
  Mean squared_error, bound;
  double ratio() const { return metrics::ratio(squared_error.value(), bound.value()); }
};

PoseErrors pose_errors(std::span<const Pose2> estimated, std::span<const Pose2> truth, double lever_m) {
  const Pose2 motion = common_motion(estimated, truth, lever_m);
  PoseErrors errors;
  for (std::size_t k = 0; k < estimated.size(); ++k) {
    const Pose2 off = truth[k].inverse() * (motion * estimated[k]);
    errors.position_m.push_back(off.translation().norm());
    errors.heading_deg.push_back(degrees(std::fabs(off.yaw())));
  }
  return errors;
}

double mean(std::span<const double> values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return ratio(sum, static_cast<double>(values.size()));
}

class AlignmentErrors : public MetricFamily {
 public:
  struct Params {
    double within_m = 0.10;
    double within_deg = 2.0;
    double lever_m = 1.0;
    double max_sigma_m = 0.1;
    static auto fields() {
      return std::tuple{
          field("within_m", &Params::within_m, above(0), "m", "largest position error of a scan that counts as placed"),
          field("within_deg", &Params::within_deg, above(0), "deg", "largest heading error of such a scan"),
          field("lever_m", &Params::lever_m, above(0), "m",
                "weight of headings in the common motion: metres per radian"),
          field("max_sigma_m", &Params::max_sigma_m, above(0), "m",
                "largest standard deviation that the bound may leave to a motion of a scan that is compared with it; "
                "yaw at lever_m")};
    }
  };

  explicit AlignmentErrors(const Params& params) : params_(params) {}

  std::vector<MetricDescription> describe() const override {
    using enum Direction;
    return {
        {"position_error", "position error", "m", lower_is_better, 0.005, "mean position error of the scans"},
        {"position_error_max", "largest position error", "m", lower_is_better, 0.01,
         "largest position error of a scan"},
        {"heading_error", "heading error", "deg", lower_is_better, 0.1, "mean absolute heading error of the scans"},
        {"heading_error_max", "largest heading error", "deg", lower_is_better, 0.2,
         "largest absolute heading error of a scan"},
        share({"placed", "scans placed", "", higher_is_better, 0.02,
               "share of the scans within within_m and within_deg"}),
        share({"all_placed", "all scans placed", "", higher_is_better, 0.0,
               "1 if every scan is within within_m and within_deg, else 0"}),
        {"start_position_error", "position error at the start", "m", neither, 0.0,
         "position_error of the given poses, before any alignment"},
        {"start_heading_error", "heading error at the start", "deg", neither, 0.0, "heading_error of the given poses"},
        {"error_ratio", "position error / at the start", "", lower_is_better, 0.02,
         "position_error / start_position_error; above 1 the alignment made the poses worse"},
        {"alignment_efficiency", "alignment MSE / bound", "", lower_is_better, 0.05,
         "geometric mean of alignment_efficiency_position and alignment_efficiency_heading"},
        {"alignment_efficiency_position", "alignment MSE / bound, position", "", lower_is_better, 0.05,
         "mean squared position error of the scans that the data determine over its mean Cramer-Rao bound, walls "
         "unknown; 1 is the best"},
        {"alignment_efficiency_heading", "alignment MSE / bound, heading", "", lower_is_better, 0.05,
         "mean squared heading error of the scans that the data determine over its mean Cramer-Rao bound, walls "
         "unknown; 1 is the best"},
        {"alignment_bound_position", "alignment bound, position", "m", neither, 0.0,
         "root of the mean bound of the position"},
        {"alignment_bound_heading", "alignment bound, heading", "deg", neither, 0.0,
         "root of the mean bound of the heading"},
        share({"alignment_determined", "scans determined", "", neither, 0.0,
               "share of the scans that the data determine to max_sigma_m"})};
  }

  bool applies(const MetricInput& input) const override {
    const std::size_t frames = input.observed.frames.size();
    return input.truth != nullptr && frames > 0 && input.truth->world_from_sensor.size() == frames &&
           input.result.world_from_sensor.size() == frames;
  }

  std::vector<MetricRow> evaluate(const MetricInput& input) const override {
    SCANBENCH_ASSERT(applies(input));
    const std::vector<Pose2>& truth = input.truth->world_from_sensor;
    std::vector<Pose2> recorded;
    for (const Frame& frame : input.observed.frames) recorded.push_back(frame.odom_from_sensor);
    const PoseErrors start = pose_errors(recorded, truth, params_.lever_m);
    const PoseErrors end = pose_errors(input.result.world_from_sensor, truth, params_.lever_m);

    const auto n = std::ssize(truth);
    std::int64_t placed = 0;
    for (std::size_t k = 0; k < truth.size(); ++k)
      placed += end.position_m[k] <= params_.within_m && end.heading_deg[k] <= params_.within_deg ? 1 : 0;
    Rows rows(describe());
    rows.add("position_error", kAll, mean(end.position_m), n);
    rows.add("position_error_max", kAll, *std::ranges::max_element(end.position_m), n);
    rows.add("heading_error", kAll, mean(end.heading_deg), n);
    rows.add("heading_error_max", kAll, *std::ranges::max_element(end.heading_deg), n);
    rows.add("placed", kAll, static_cast<double>(placed) / static_cast<double>(n), n);
    rows.add("all_placed", kAll, placed == n ? 1.0 : 0.0, 1);
    rows.add("start_position_error", kAll, mean(start.position_m), n);
    rows.add("start_heading_error", kAll, mean(start.heading_deg), n);
    rows.add("error_ratio", kAll, ratio(mean(end.position_m), mean(start.position_m)), n);
    if (has_beam_truth(input) && input.observed.sensor.noise.range_sigma(1.0) > 0) add_efficiency(rows, input);
    return rows.take();
  }

 private:
  void add_efficiency(Rows& rows, const MetricInput& input) const {
    const std::vector<Pose2>& truth = input.truth->world_from_sensor;
    const auto bound = joint_pose_bound(input, params_.max_sigma_m, params_.lever_m);
    const std::size_t determined = bound ? bound->scans.size() : 0;
    JointEfficiency position, heading;
    if (bound) {
      std::vector<Pose2> chosen, chosen_truth;
      for (const std::size_t scan : bound->scans) {
        chosen.push_back(input.result.world_from_sensor[scan]);
        chosen_truth.push_back(truth[scan]);
      }
      const PoseErrors errors = pose_errors(chosen, chosen_truth, params_.lever_m);
      for (std::size_t k = 0; k < determined; ++k) {
        const double turn = radians(errors.heading_deg[k]);
        position.squared_error.add(errors.position_m[k] * errors.position_m[k]);
        position.bound.add(bound->position[k]);
        heading.squared_error.add(turn * turn);
        heading.bound.add(bound->heading[k]);
      }
    }
    const auto n = std::ssize(truth);
    rows.add("alignment_efficiency", kAll, std::sqrt(position.ratio() * heading.ratio()), position.bound.count());
    rows.add("alignment_efficiency_position", kAll, position.ratio(), position.bound.count());
    rows.add("alignment_efficiency_heading", kAll, heading.ratio(), heading.bound.count());
    rows.add("alignment_bound_position", kAll, position.bound.root(), position.bound.count());
    rows.add("alignment_bound_heading", kAll, degrees(heading.bound.root()), heading.bound.count());
    rows.add("alignment_determined", kAll, static_cast<double>(determined) / static_cast<double>(n), n);
  }

  Params params_;
};

SCANBENCH_REGISTER(
    MetricFamily, AlignmentErrors,
    {.name = "alignment",
     .summary = "errors of the poses of all scans against the truth, without the motion that is common to all",
     .reference =
         "Lakaemper 2010, section 6 judges by eye; the errors are ours; bound: Censi 2007, On achievable accuracy "
         "for range-finder localization, ICRA, extended to unknown walls and many scans"});

}  // namespace
}  // namespace scanbench::metrics
