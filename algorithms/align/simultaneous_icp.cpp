// Simultaneous ICP: pairs each point with the nearest point of every other scan and solves for all poses together. It
// uses the network of pairwise relations of Lu & Milios, "Globally consistent range scan alignment for environment
// mapping", Autonomous Robots 4, 1997, with the closest points in place of the relations, as Borrmann et al. solve it
// (Robotics and Autonomous Systems 56, 2008). Lakaemper 2010, section 3, names it as the competitor of force field
// simulation: it has hard correspondences, force field simulation has soft ones. Both work on the same resampled
// points.
#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithms/align/ffs/body.hpp"
#include "algorithms/align/ffs/meeting.hpp"
#include "algorithms/align/parts/cell_grid.hpp"
#include "algorithms/align/parts/joint_equations.hpp"
#include "algorithms/align/parts/outcome.hpp"
#include "algorithms/align/parts/register_scan.hpp"
#include "algorithms/align/parts/round_row.hpp"
#include "core/modules.hpp"
#include "core/number_text.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

using align::ffs::Body;

constexpr int kFewestShared = 5;

class SimultaneousIcp final : public Aligner {
 public:
  struct Params {
    double resample_m = 0.1;
    double odometry_sigma_m = 0.05;
    double odometry_sigma_deg = 3.0;
    double final_gate_m = 0.15;
    double max_angle_deg = 30.0;
    int max_rounds = 100;

    static auto fields() {
      return std::tuple{field("resample_m", &Params::resample_m, between(1e-4, 1e3), "m",
                              "distance of the points along the lines of a scan"),
                        field("odometry_sigma_m", &Params::odometry_sigma_m, between(1e-6, 1e6), "m",
                              "standard deviation of a given position, each axis; sets the widest gate"),
                        field("odometry_sigma_deg", &Params::odometry_sigma_deg, between(0, 180), "deg",
                              "standard deviation of a given heading; sets the widest gate"),
                        field("final_gate_m", &Params::final_gate_m, between(1e-6, 1e6), "m",
                              "largest distance of two partners; the gate is halved from round to round down to this"),
                        field("max_angle_deg", &Params::max_angle_deg, between(0, 90), "deg",
                              "largest angle between the lines of two partners"),
                        field("max_rounds", &Params::max_rounds, between(1, 1e6), "",
                              "solutions at most; fewer once no pose moves 0.1 mm or 1e-5 rad")};
    }
  };

  explicit SimultaneousIcp(const Params& params) : params_(params) {}

  Alignment align(std::span<const Observation> scans, std::span<const Pose2> initial, Trace& trace) const override;

 private:
  Params params_;
};

/// All points, placed in the world.
struct Cloud {
  std::vector<Vec2> at;
  std::vector<Vec2> along;
  std::vector<std::size_t> scan;
};

Cloud placed(const std::vector<Body>& bodies, const std::vector<Pose2>& poses) {
  Cloud cloud;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (std::size_t k = 0; k < bodies[b].points.size(); ++k) {
      cloud.at.push_back(poses[b] * bodies[b].points[k]);
      cloud.along.push_back(poses[b].rotate(bodies[b].directions[k]));
      cloud.scan.push_back(b);
    }
  return cloud;
}

/// Calls visit(v, u) for every point v and its nearest aligned neighbour u of every other scan within the gate.
template <class Visit>
void for_each_pair(const Cloud& cloud, double gate_m, double min_aligned, std::size_t scans, const Visit& visit) {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  const align::CellGrid grid(cloud.at, gate_m);
  std::vector<std::size_t> nearest(scans, kNone);
  std::vector<std::size_t> met;
  for (std::size_t v = 0; v < cloud.at.size(); ++v) {
    const auto squared = [&](std::size_t u) { return (cloud.at[u] - cloud.at[v]).squaredNorm(); };
    grid.for_each_near(cloud.at[v], [&](std::size_t u) {
      const std::size_t scan = cloud.scan[u];
      if (scan == cloud.scan[v] || squared(u) > gate_m * gate_m) return;
      if (std::fabs(cloud.along[u].dot(cloud.along[v])) < min_aligned) return;
      if (nearest[scan] == kNone) met.push_back(scan);
      if (nearest[scan] == kNone || squared(u) < squared(nearest[scan])) nearest[scan] = u;
    });
    for (const std::size_t scan : met) visit(v, std::exchange(nearest[scan], kNone));
    met.clear();
  }
}

struct Round {
  align::Move largest;
  int pairs = 0;
  double squares = 0.0;
  int lowest_rank = 3;
  align::ScanGroups groups;
};

/// Gauss-Newton on the sum of squared distances of all pairs of partners.
Round solve_round(const std::vector<Body>& bodies, const std::vector<double>& levers, double gate_m, double min_aligned,
                  std::vector<Pose2>& poses) {
  const Cloud cloud = placed(bodies, poses);
  Round round;
  align::JointEquations equations(bodies.size());
  std::size_t current = 0;
  for_each_pair(cloud, gate_m, min_aligned, bodies.size(), [&](std::size_t v, std::size_t u) {
    const std::size_t i = cloud.scan[v], j = cloud.scan[u];
    if (i != current) equations.finish(std::exchange(current, i));
    const Vec2 off = cloud.at[v] - cloud.at[u];
    for (const Vec2& axis : {Vec2(1, 0), Vec2(0, 1)})
      equations.add(i, align::row_of(axis, cloud.at[v], poses[i].translation(), levers[i]), j,
                    -align::row_of(axis, cloud.at[u], poses[j].translation(), levers[j]), axis.dot(off), 1.0);
    round.squares += off.squaredNorm();
    ++round.pairs;
  });
  equations.finish(current);
  round.groups = equations.groups(2 * kFewestShared);  // two residuals per pair
  const std::vector<Eigen::Vector3d> motions = equations.solve(round.lowest_rank);
  for (std::size_t k = 1; k < poses.size(); ++k) {
    const align::Move move = align::move_by(motions[k], levers[k], poses[k]);
    round.largest.shift_m = std::max(round.largest.shift_m, move.shift_m);
    round.largest.turn_rad = std::max(round.largest.turn_rad, move.turn_rad);
  }
  return round;
}

/// True if a scan could move along what it meets. The equations do not show it: the distance of two points also holds
/// along a wall, where the partners' places are those of the sampling.
bool some_scan_slides(const std::vector<Body>& bodies, const std::vector<Pose2>& poses, double reach_m) {
  const Cloud cloud = placed(bodies, poses);
  align::ffs::FieldPoints points;
  for (std::size_t k = 0; k < cloud.at.size(); ++k)
    points.add(cloud.at[k], cloud.along[k], 1.0, static_cast<int>(cloud.scan[k]));
  return !align::ffs::meeting_of(bodies, poses, points, {}, reach_m).sliding.empty();
}

Alignment SimultaneousIcp::align(std::span<const Observation> scans, std::span<const Pose2> initial,
                                 Trace& trace) const {
  Alignment result;
  result.world_from_sensor.assign(initial.begin(), initial.end());
  result.message = align::unusable_pose(initial);
  if (!result.message.empty()) result.status = Status::degenerate;
  if (scans.size() < 2 || !result.message.empty()) return result;

  trace.stage(Stage::resample);
  std::vector<Body> bodies;
  std::vector<double> levers, known_levers;
  for (const Observation& scan : scans) {
    bodies.push_back(align::ffs::body_of(scan, params_.resample_m));
    const Body& body = bodies.back();
    const double lever = body.points.empty() ? 1.0 : std::sqrt(body.inertia / body.mass() + body.centre.squaredNorm());
    levers.push_back(std::max(lever, 1e-3));
    if (!body.points.empty()) known_levers.push_back(levers.back());
  }
  const align::OdometryError odometry{params_.odometry_sigma_m, radians(params_.odometry_sigma_deg)};
  const align::Gates gates{std::max(align::gate_for(odometry, known_levers), params_.final_gate_m),
                           params_.final_gate_m};
  const double min_aligned = std::cos(radians(params_.max_angle_deg));

  trace.stage(Stage::joint);
  std::vector<Pose2> poses(initial.begin(), initial.end());
  Round last;
  bool converged = false;
  int rounds = 0;
  for (; rounds < params_.max_rounds && !converged; ++rounds) {
    last = solve_round(bodies, levers, gates.at(rounds), min_aligned, poses);
    converged = gates.narrow(rounds) && last.largest.small();
    trace.row(align::RoundRow{rounds, gates.at(rounds), last.pairs, std::sqrt(last.squares / std::max(last.pairs, 1)),
                              last.largest.shift_m, last.largest.turn_rad});
  }
  const bool slides = last.lowest_rank < 3 || some_scan_slides(bodies, poses, gates.narrow_m);
  return align::judged({last.groups, slides, converged, rounds, last.largest}, initial, poses);
}

SCANBENCH_REGISTER(Aligner, SimultaneousIcp,
                   {.name = "simultaneous_icp",
                    .summary = "all pairs of scans by nearest points (hard correspondences), all poses solved together",
                    .reference = "Lu & Milios 1997; Borrmann et al. 2008"});

}  // namespace
}  // namespace scanbench
