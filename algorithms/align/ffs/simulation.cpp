// The loop of section 5: computes the field, makes a step and finds new hypotheses until the map is stable.
#include "algorithms/align/ffs/simulation.hpp"

#include <algorithm>
#include <cmath>

#include "algorithms/align/ffs/meeting.hpp"
#include "algorithms/align/ffs/rigid_step.hpp"
#include "algorithms/align/parts/outcome.hpp"
#include "core/contracts/force_field_trace.hpp"

namespace scanbench::align::ffs {
namespace {

constexpr double kSettled = 1e-3;     // share of sigma_end_m
constexpr double kLongestStep = 1.0;  // in sigma; a longer step would leave the field from which it was computed
constexpr double kMeetingSigmas = 2.0;

/// Bodies, their poses and their placed points.
class Simulation {
 public:
  Simulation(std::span<const Observation> scans, std::span<const Pose2> initial, const Schedule& schedule)
      : schedule_(schedule), world_from_map_(initial.front()) {
    for (std::size_t k = 0; k < scans.size(); ++k) {
      bodies_.push_back(body_of(scans[k], schedule.resample_m));
      poses_.push_back(world_from_map_.inverse() * initial[k]);
      body_of_line_.insert(body_of_line_.end(), bodies_.back().lines.size(), static_cast<int>(k));
    }
  }

  bool run(const Hypothesize& hypothesize, Trace& trace) {
    int settled = 0;
    double step = 0.0;
    for (int t = 0; t < schedule_.max_iterations && settled < 2; ++t) {
      place();
      if (t > 0 && hypothesize) virtual_scan_ = hypothesize(map_at(t), trace);
      trace_poses(t, trace);
      step = iterate(t, step, trace);
      settled = schedule_.cooled(t) && largest_move_ < kSettled * schedule_.sigma_end_m ? settled + 1 : 0;
    }
    place();
    trace_poses(iterations_, trace);
    return settled == 2;
  }

  Meeting meeting() const {
    return meeting_of(bodies_, poses_, points_, virtual_scan_, kMeetingSigmas * schedule_.sigma_end_m);
  }
  std::vector<Pose2> world_poses(std::span<const Pose2> initial) const {
    std::vector<Pose2> poses;
    for (const Pose2& pose : poses_) poses.push_back(world_from_map_ * pose);
    return held_at_first(initial, poses);
  }
  const std::vector<Body>& bodies() const { return bodies_; }
  int iterations() const { return iterations_; }
  double largest_move() const { return largest_move_; }

 private:
  void place() {
    points_.truncate(0);
    lines_.clear();
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      for (std::size_t k = 0; k < bodies_[b].points.size(); ++k)
        points_.add(poses_[b] * bodies_[b].points[k], poses_[b].rotate(bodies_[b].directions[k]), 1.0,
                    static_cast<int>(b));
      for (const Segment& line : bodies_[b].lines) lines_.push_back(poses_[b] * line);
    }
  }

  CurrentMap map_at(int t) const { return {t, points_, lines_, body_of_line_, world_from_map_}; }

  /// One iteration; returns dt^2 / 2, which never grows.
  double iterate(int t, double step_before, Trace& trace) {
    const Field field{schedule_.sigma_at(t), schedule_.cut_sigmas, schedule_.soft_sigmas};
    const std::size_t real = points_.size();
    for (std::size_t k = 0; k < virtual_scan_.points.size(); ++k)
      points_.add(virtual_scan_.points[k], virtual_scan_.directions[k], virtual_scan_.weights[k],
                  static_cast<int>(bodies_.size()));
    point_forces(points_, field, forces_);
    const double depth = trace.recording() ? potential(points_, field) : 0.0;
    points_.truncate(real);
    const std::vector<Drive> drives = drives_of(bodies_, poses_, points_, forces_);
    double step = schedule_.step_at(t) * largest_step(drives, stiffness_on_line(schedule_.resample_m, field));
    if (step_before > 0 && step > step_before) step = step_before;
    largest_move_ = move(bodies_, drives, step, kLongestStep * field.sigma, poses_);
    if (trace.recording())
      trace.row(force_field::IterationRow{t, field.sigma, step, depth, largest_move_,
                                          static_cast<int>(virtual_scan_.points.size())});
    iterations_ = t + 1;
    return step;
  }

  void trace_poses(int t, Trace& trace) const {
    if (!trace.recording()) return;
    for (std::size_t b = 0; b < poses_.size(); ++b) {
      const Pose2 pose = world_from_map_ * poses_[b];
      trace.row(force_field::PoseRow{t, static_cast<int>(b), pose.x(), pose.y(), pose.yaw()});
    }
  }

  Schedule schedule_;
  Pose2 world_from_map_;  ///< the frame of the map is that of the first scan as given
  std::vector<Body> bodies_;
  std::vector<Pose2> poses_;  ///< map from sensor
  std::vector<int> body_of_line_;
  FieldPoints points_;
  std::vector<Segment> lines_;
  VirtualScan virtual_scan_;
  std::vector<PointForce> forces_;
  double largest_move_ = 0.0;
  int iterations_ = 0;
};

void add_sentence(const std::string& sentence, std::string& text) {
  if (!sentence.empty()) text += (text.empty() ? "" : "; ") + sentence;
}

std::string sliding_text(const std::vector<std::size_t>& sliding) {
  if (sliding.empty()) return "";
  std::string text = std::to_string(sliding.size()) + " scans can slide along what they meet: ";
  for (std::size_t k = 0; k < std::min<std::size_t>(sliding.size(), 8); ++k)
    text += (k > 0 ? ", " : "") + std::to_string(sliding[k]);
  return text + (sliding.size() > 8 ? ", ..." : "");
}

}  // namespace

Alignment simulate(std::span<const Observation> scans, std::span<const Pose2> initial, const Schedule& schedule,
                   const Hypothesize& hypothesize, Trace& trace) {
  Alignment result;
  result.world_from_sensor.assign(initial.begin(), initial.end());
  result.message = unusable_pose(initial);
  if (!result.message.empty()) result.status = Status::degenerate;
  if (scans.size() < 2 || !result.message.empty()) return result;

  trace.stage(Stage::resample);
  Simulation simulation(scans, initial, schedule);
  trace.stage(Stage::simulate);
  const bool converged = simulation.run(hypothesize, trace);
  trace.stage(Stage::judge);
  const Meeting meeting = simulation.meeting();
  add_sentence(meeting.groups.complaint(), result.message);
  add_sentence(sliding_text(meeting.sliding), result.message);
  if (meeting.groups.groups().size() == scans.size()) {
    result.status = Status::no_match;
    return result;
  }
  if (!converged) {
    result.status = Status::max_iterations;
    add_sentence("points still moved by " + movement_text(simulation.largest_move()) + " m in iteration " +
                     std::to_string(simulation.iterations()),
                 result.message);
  }
  if (!meeting.groups.together() || !meeting.sliding.empty()) result.status = Status::degenerate;
  result.world_from_sensor = simulation.world_poses(initial);
  return result;
}

}  // namespace scanbench::align::ffs
