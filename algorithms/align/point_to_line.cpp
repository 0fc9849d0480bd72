// Multi-scan point-to-line ICP: registers the points of every scan on the lines of all other scans. The registration of
// one scan is the segment-point method of Siadat et al. 1997, section 7; here every scan takes the place of the map.
// docs/algorithms/point_to_line.md has the objective and the departures from the text.
//
// Results for difficult input: no scan or a single scan is converged, with its pose unchanged. A scan without partners
// (no returns, or no lines near them) keeps its place in the start, and the status is degenerate. If no scan has
// partners, the poses are those given and the status is no_match.
#include <algorithm>
#include <cmath>

#include "algorithms/align/parts/joint_step.hpp"
#include "algorithms/align/parts/outcome.hpp"
#include "algorithms/align/parts/register_scan.hpp"
#include "algorithms/align/parts/round_row.hpp"
#include "core/modules.hpp"
#include "core/number_text.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

constexpr double kClearlyBetter = 1.01;  // of two starts that lead to one map, the chain is taken

class PointToLine final : public Aligner {
 public:
  struct Params {
    double odometry_sigma_m = 0.05;
    double odometry_sigma_deg = 3.0;
    double gate_m = 0.0;
    double final_gate_m = 0.1;
    double margin_m = 0.2;
    double max_angle_deg = 30.0;
    int max_rounds = 20;

    static auto fields() {
      return std::tuple{
          field("odometry_sigma_m", &Params::odometry_sigma_m, between(1e-6, 1e6), "m",
                "standard deviation of a given position, each axis"),
          field("odometry_sigma_deg", &Params::odometry_sigma_deg, between(0, 180), "deg",
                "standard deviation of a given heading"),
          field("gate_m", &Params::gate_m, between(0, 1e6), "m",
                "largest distance of a point from its line at first; halves from step to step; 0 derives it from the "
                "error of the given poses"),
          field("final_gate_m", &Params::final_gate_m, between(1e-6, 1e6), "m",
                "down to this; weights of pairs fall to 0 there (Tukey)"),
          field("margin_m", &Params::margin_m, between(0, 1e6), "m",
                "how far a point may be beyond the ends of its line"),
          field("max_angle_deg", &Params::max_angle_deg, between(0, 180), "deg",
                "largest angle between a line and the line that the point supports in its own scan; 180: any"),
          field("max_rounds", &Params::max_rounds, between(1, 1e6), "",
                "steps of all poses together at most; fewer once none moves 0.1 mm or 1e-5 rad")};
    }
  };

  explicit PointToLine(const Params& p)
      : odometry_{p.odometry_sigma_m, radians(p.odometry_sigma_deg)},
        gates_{p.gate_m, p.final_gate_m},
        rules_{p.gate_m, p.margin_m, std::cos(radians(p.max_angle_deg))},
        max_rounds_(p.max_rounds) {
    if (p.gate_m > 0 && p.final_gate_m > p.gate_m)
      throw ParamError("final_gate_m", "final_gate_m = " + number_text(p.final_gate_m) + " m is larger than gate_m = " +
                                           number_text(p.gate_m) + " m; allowed: up to gate_m");
  }

  Alignment align(std::span<const Observation> scans, std::span<const Pose2> initial, Trace& trace) const override;

 private:
  PointToLine with_gate(double wide_m) const;
  Alignment align_shapes(std::span<const align::ScanShape> shapes, std::span<const Pose2> initial, Trace& trace) const;
  std::vector<Pose2> one_after_the_other(std::span<const align::ScanShape> scans, std::span<const Pose2> initial,
                                         double longest_m) const;
  /// The rounds from one start, so far.
  struct Course {
    std::vector<Pose2> poses;
    align::JointStep last{};
    std::vector<align::RoundRow> rows{};
    bool converged = false;
  };
  void advance(std::span<const align::ScanShape> shapes, double longest_m, int rounds, Course& course) const;
  Course best_course(std::span<const align::ScanShape> shapes, std::span<const Pose2> initial, double longest_m,
                     Trace& trace) const;

  align::OdometryError odometry_;
  align::Gates gates_;
  align::PartnerRules rules_;  ///< the gate is the widest one
  int max_rounds_;
};

/// Poses in the frame of the first scan. Each scan is registered on the lines of the scans before it.
std::vector<Pose2> PointToLine::one_after_the_other(std::span<const align::ScanShape> scans,
                                                    std::span<const Pose2> initial, double longest_m) const {
  std::vector<Pose2> poses(scans.size());
  align::LineGrid before(rules_, longest_m);
  for (std::size_t k = 0; k < scans.size(); ++k) {
    if (k > 0) {
      const Pose2 step = initial[k - 1].inverse() * initial[k];
      poses[k] = align::register_scan(scans[k], before, poses[k - 1] * step, rules_, gates_);
    }
    before.add(static_cast<int>(k), poses[k], scans[k].lines);
  }
  return poses;
}

void PointToLine::advance(std::span<const align::ScanShape> shapes, double longest_m, int rounds,
                          Course& course) const {
  for (int round = static_cast<int>(course.rows.size()); round < rounds && !course.converged; ++round) {
    align::PartnerRules rules = rules_;
    rules.gate_m = gates_.at(round);
    course.last = align::joint_step(shapes, rules, longest_m, course.poses);
    const align::JointStep& step = course.last;
    course.converged = gates_.narrow(round) && step.largest.small();
    course.rows.push_back({round, rules.gate_m, step.pairs, step.rms_m, step.largest.shift_m, step.largest.turn_rad});
  }
}

/// Odometry drifts, but its steps are good. Poses that were set by hand or estimated are each a little wrong, and so is
/// every step, so that the errors of a chain of steps add up. Which of both the given poses are shows in the maps that
/// the two starts lead to, once the gate is narrow: in the right one more points agree with the lines of other scans.
PointToLine::Course PointToLine::best_course(std::span<const align::ScanShape> shapes, std::span<const Pose2> initial,
                                             double longest_m, Trace& trace) const {
  trace.stage(Stage::one_by_one);
  Course chain, given;
  chain.poses = one_after_the_other(shapes, initial, longest_m);
  for (const Pose2& pose : initial) given.poses.push_back(initial.front().inverse() * pose);
  trace.stage(Stage::joint);
  int rounds = 1;
  while (rounds < max_rounds_ && !gates_.narrow(rounds - 1)) ++rounds;
  align::PartnerRules rules = rules_;
  rules.gate_m = gates_.narrow_m;
  const auto agreement = [&](Course& course) {
    advance(shapes, longest_m, rounds, course);
    return align::agreement(shapes, rules, longest_m, course.poses);
  };
  const double of_chain = agreement(chain), of_given = agreement(given);
  return of_given > kClearlyBetter * of_chain ? given : chain;
}

PointToLine PointToLine::with_gate(double wide_m) const {
  PointToLine other = *this;
  other.gates_.wide_m = other.rules_.gate_m = std::max(wide_m, gates_.narrow_m);
  return other;
}

Alignment PointToLine::align(std::span<const Observation> scans, std::span<const Pose2> initial, Trace& trace) const {
  Alignment result;
  result.world_from_sensor.assign(initial.begin(), initial.end());
  result.message = align::unusable_pose(initial);
  if (!result.message.empty()) result.status = Status::degenerate;
  if (scans.size() < 2 || !result.message.empty()) return result;

  std::vector<align::ScanShape> shapes;
  std::vector<double> levers;
  for (const Observation& scan : scans) {
    shapes.push_back(align::shape_of(scan));
    if (!shapes.back().readings.empty()) levers.push_back(shapes.back().lever_m);
  }
  if (gates_.wide_m > 0) return align_shapes(shapes, initial, trace);
  return with_gate(align::gate_for(odometry_, levers)).align_shapes(shapes, initial, trace);
}

Alignment PointToLine::align_shapes(std::span<const align::ScanShape> shapes, std::span<const Pose2> initial,
                                    Trace& trace) const {
  double longest = 0.0;
  for (const align::ScanShape& shape : shapes)
    for (const Segment& line : shape.lines) longest = std::max(longest, line.length());

  Course course = best_course(shapes, initial, longest, trace);
  advance(shapes, longest, max_rounds_, course);
  for (const align::RoundRow& row : course.rows) trace.row(row);

  const align::JointStep& last = course.last;
  const align::Outcome outcome{last.groups, last.lowest_rank < 3, course.converged, max_rounds_, last.largest};
  return align::judged(outcome, initial, course.poses);
}

SCANBENCH_REGISTER(
    Aligner, PointToLine,
    {.name = "point_to_line",
     .summary = "the points of every scan on the lines of all others: point-to-line ICP of all poses together",
     .reference = "Siadat et al. 1997, section 7 (segment-point), with every scan in the place of the map"});

}  // namespace
}  // namespace scanbench
