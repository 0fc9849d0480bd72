// The errors of position and heading along the path, one curve per pipeline. They are those whose root mean square the
// metric family `trajectory` reports: of the poses after one motion of the plane.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/geometry/plane_alignment.hpp"
#include "core/geometry/pose_errors.hpp"
#include "core/registry.hpp"
#include "render/figures/parts/frames.hpp"
#include "render/figures/parts/style.hpp"

namespace scanbench::render {
namespace {

const Stroke kOdometry{kGrey, 0.9, Dash::dotted};
constexpr double kErrorCurveWidth = 1.1;

enum class Motion { best, first, none };

struct NamedPoses {
  std::string name;
  std::vector<Pose2> poses;
};

class TrajectoryError : public Figure {
 public:
  struct Params {
    Motion align = Motion::best;
    double lever_m = 1.0;
    static auto fields() {
      return std::tuple{
          choice("align", &Params::align, {{Motion::best, "best"}, {Motion::first, "first"}, {Motion::none, "none"}},
                 "the motion before the comparison: the one that brings all poses nearest to the true ones, the one "
                 "that brings the first pose onto the true one, or none"),
          field("lever_m", &Params::lever_m, above(0), "m",
                "metres of position that count as a radian of heading in the best motion")};
    }
  };
  explicit TrajectoryError(const Params& params) : params_(params) {}

  std::string why_nothing(const FigureInput&) const override {
    return "there are no true poses, or no pipeline has a pose for every scan";
  }

  std::vector<NamedScene> draw(const FigureInput& input) const override {
    const std::vector<Pose2> truth = true_poses(input.recording);
    std::vector<Pose2> odometry;
    odometry.reserve(input.recording.observed.frames.size());
    for (const Frame& frame : input.recording.observed.frames) odometry.push_back(frame.odom_from_sensor);
    std::vector<NamedPoses> shown;
    for (const NamedResult& named : input.results)
      if (named.result->world_from_sensor.size() == truth.size() && differ(named.result->world_from_sensor, odometry))
        shown.push_back({named.pipeline, named.result->world_from_sensor});
    if (truth.empty() || (shown.empty() && odometry.size() != truth.size())) return {};

    Panel position{
        .x = {.label = "path [m]"}, .y = {.label = "position error", .unit = "m"}, .equal_aspect = false, .items = {}};
    Panel heading{.x = {.label = "path [m]"}, .y = {.label = "heading error [°]"}, .equal_aspect = false, .items = {}};
    Scene scene{.width_in = kDoubleColumnIn, .title = input.title + ": errors along the path", .columns = 2};
    const std::vector<double> path = path_of(truth);
    if (odometry.size() == truth.size() && differ(odometry, truth)) {
      add_curves(odometry, truth, path, kOdometry, position, heading);
      scene.legend.push_back({.text = "odometry", .stroke = kOdometry});
    }
    std::vector<std::string> names;
    names.reserve(shown.size());
    for (const NamedPoses& poses : shown) names.push_back(poses.name);
    const std::vector<MethodStyle> styles = method_styles(names);
    for (std::size_t i = 0; i < shown.size(); ++i) {
      const Stroke stroke{styles[i].color, kErrorCurveWidth, styles[i].dash};
      add_curves(shown[i].poses, truth, path, stroke, position, heading);
      scene.legend.push_back({.text = names[i], .stroke = stroke});
    }
    if (position.items.empty()) return {};
    scene.panels = {std::move(position), std::move(heading)};
    return {{"trajectory_error",
             fmt::format("{}: distance of the estimated from the {} positions, and difference of the headings, {}.",
                         input.title, standard_name(input.recording), motion_text(standard_name(input.recording))),
             std::move(scene)}};
  }

 private:
  static std::vector<Pose2> true_poses(const Recording& recording) {
    std::vector<Pose2> poses;
    if (recording.truth)
      poses = recording.truth->world_from_sensor;
    else if (recording.reference)
      poses = recording.reference->world_from_sensor;
    return poses.size() == recording.observed.frames.size() ? poses : std::vector<Pose2>();
  }

  static std::vector<double> path_of(const std::vector<Pose2>& poses) {
    std::vector<double> path(poses.size(), 0.0);
    for (std::size_t k = 1; k < poses.size(); ++k)
      path[k] = path[k - 1] + (poses[k].translation() - poses[k - 1].translation()).norm();
    return path;
  }

  /// What the poses are compared with. The reference poses of a log are not the truth.
  static std::string standard_name(const Recording& recording) { return recording.truth ? "true" : "reference"; }

  std::string motion_text(const std::string& standard) const {
    switch (params_.align) {
      case Motion::best:
        return "after the motion that brings all poses nearest to the " + standard + " ones";
      case Motion::first:
        return "after the motion that brings the first pose onto the " + standard + " one";
      default:
        return "in the frame of the " + standard + " poses";
    }
  }

  Pose2 motion(const std::vector<Pose2>& poses, const std::vector<Pose2>& truth) const {
    switch (params_.align) {
      case Motion::best:
        return align_trajectories(poses, truth, params_.lever_m);
      case Motion::first:
        return truth.front() * poses.front().inverse();
      default:
        return {};
    }
  }

  void add_curves(const std::vector<Pose2>& poses, const std::vector<Pose2>& truth, const std::vector<double>& path,
                  const Stroke& stroke, Panel& position, Panel& heading) const {
    const Pose2 aligned_from_estimated = motion(poses, truth);
    Polyline shifts{.stroke = stroke}, turns{.stroke = stroke};
    for (std::size_t k = 0; k < truth.size(); ++k) {
      const Eigen::Vector3d e = pose_error(aligned_from_estimated * poses[k], truth[k]);
      shifts.points.emplace_back(path[k], e.head<2>().norm());
      turns.points.emplace_back(path[k], degrees(e.z()));
    }
    position.items.emplace_back(std::move(shifts));
    heading.items.emplace_back(std::move(turns));
  }

  Params params_;
};

SCANBENCH_REGISTER(Figure, TrajectoryError,
                   {.name = "trajectory_error",
                    .summary = "errors of position and heading along the path, a curve per pipeline, with the odometry",
                    .reference = ""});

}  // namespace
}  // namespace scanbench::render
