// point_to_line: multi-scan point-to-line ICP. The points of every scan are registered on the lines of all others. The
// registration of one scan is the segment-point method of Siadat et al. 1997, section 7, with every scan in the place
// of the map. docs/algorithms/point_to_line.md has the objective and the departures from the text.
//
// Answers for difficult input: no scan or one scan keeps its pose, converged. A scan without partners (no returns, or
// no lines near them) keeps its odometry step from the scan before it, and the status is degenerate. If no scan has a
// partner, the poses are those given, no_match.
#include <algorithm>
#include <cmath>

#include "algorithms/align/point_to_line/joint_step.hpp"
#include "algorithms/align/point_to_line/register_scan.hpp"
#include "core/modules.hpp"
#include "core/number_text.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

/// A step of all poses together.
struct RoundRow {
  static constexpr std::string_view kName = "round";
  int round = 0;
  double gate_m = 0.0;
  int pairs = 0;
  double rms_m = 0.0;
  double largest_shift_m = 0.0;
  double largest_turn_rad = 0.0;
  static constexpr auto columns() {
    using R = RoundRow;
    return std::tuple{column("round", &R::round),
                      column("gate_m", &R::gate_m),
                      column("pairs", &R::pairs),
                      column("rms_m", &R::rms_m),
                      column("largest_shift_m", &R::largest_shift_m),
                      column("largest_turn_rad", &R::largest_turn_rad)};
  }
};

class PointToLine final : public Aligner {
 public:
  struct Params {
    double gate_m = 0.5;
    double final_gate_m = 0.1;
    double margin_m = 0.2;
    double max_angle_deg = 30.0;
    int max_rounds = 20;

    static auto fields() {
      return std::tuple{
          field("gate_m", &Params::gate_m, between(1e-6, 1e6), "m",
                "largest distance of a point from its line in the first step; it halves from step to step"),
          field("final_gate_m", &Params::final_gate_m, between(1e-6, 1e6), "m",
                "smallest value of gate_m; the weight of a pair is 0 at the gate (Tukey)"),
          field("margin_m", &Params::margin_m, between(0, 1e6), "m",
                "largest distance of a point beyond the ends of its line"),
          field("max_angle_deg", &Params::max_angle_deg, between(0, 180), "deg",
                "largest angle between a line and the line that the point supports in its own scan; 180 disables "
                "the limit"),
          field("max_rounds", &Params::max_rounds, between(1, 1e6), "",
                "largest number of steps of all poses together; they end when none moves 0.1 mm or 1e-5 rad")};
    }
  };

  explicit PointToLine(const Params& p)
      : gates_{p.gate_m, p.final_gate_m},
        rules_{p.gate_m, p.margin_m, std::cos(radians(p.max_angle_deg))},
        max_rounds_(p.max_rounds) {
    if (p.final_gate_m > p.gate_m)
      throw ParamError("final_gate_m", "final_gate_m = " + number_text(p.final_gate_m) + " m is larger than gate_m = " +
                                           number_text(p.gate_m) + " m; allowed: up to gate_m");
  }

  Alignment align(std::span<const Observation> scans, std::span<const Pose2> initial, Trace& trace) const override;

 private:
  std::vector<Pose2> one_after_the_other(std::span<const align::ScanShape> scans, std::span<const Pose2> initial,
                                         double longest_m) const;

  align::Gates gates_;
  align::PartnerRules rules_;  ///< with the widest gate
  int max_rounds_;
};

/// Poses in the frame of the first scan, each registered against the lines of the scans before it.
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

Alignment PointToLine::align(std::span<const Observation> scans, std::span<const Pose2> initial, Trace& trace) const {
  Alignment result;
  result.world_from_sensor.assign(initial.begin(), initial.end());
  if (scans.size() < 2) return result;

  std::vector<align::ScanShape> shapes;
  double longest = 0.0;
  for (const Observation& scan : scans) {
    shapes.push_back(align::shape_of(scan));
    for (const Segment& line : shapes.back().lines) longest = std::max(longest, line.length());
  }

  trace.stage(Stage::one_by_one);
  std::vector<Pose2> poses = one_after_the_other(shapes, initial, longest);

  trace.stage(Stage::joint);
  align::JointStep last;
  bool converged = false;
  for (int round = 0; round < max_rounds_ && !converged; ++round) {
    align::PartnerRules rules = rules_;
    rules.gate_m = gates_.at(round);
    last = align::joint_step(shapes, rules, longest, poses);
    converged = gates_.is_narrowest(round) && last.largest.negligible();
    trace.row(RoundRow{round, rules.gate_m, last.pairs, last.rms_m, last.largest.shift_m, last.largest.turn_rad});
  }

  if (last.pairs == 0) {
    result.status = Status::no_match;
    return result;
  }
  if (!converged) result.status = Status::max_iterations;
  if (last.lowest_rank < 3) result.status = Status::degenerate;
  for (std::size_t k = 1; k < scans.size(); ++k) result.world_from_sensor[k] = initial[0] * poses[k];
  return result;
}

[[maybe_unused]] const bool registered = Registry<Aligner>::add<PointToLine>(
    {.name = "point_to_line",
     .summary = "point-to-line ICP of all poses together: the points of every scan on the lines of all others",
     .reference = "Siadat et al. 1997, section 7 (segment-point), with every scan in the place of the map"});

}  // namespace
}  // namespace scanbench
