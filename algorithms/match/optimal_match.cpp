// optimal_match: the pose of greatest likelihood under the sensor's noise, by the walls that both scans see.
// docs/algorithms/scan_matching.md, section 3.
//
// A wall seen by two scans is measured twice, each time with the covariance of its line; its true place is unknown.
// With the true place eliminated, the two measured places differ by a normal error of covariance C1 + C2, and the pose
// of greatest likelihood minimises the sum of the normalised squared differences. Its bound is that of
// `pose_efficiency` with walls unknown. The search starts from the guess, twice from the pose of point-to-line
// registration, and from turned guesses if the result is in doubt; the most probable result is kept.
#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "algorithms/match/optimal/lone_returns.hpp"
#include "algorithms/match/optimal/wall_pairs.hpp"
#include "algorithms/match/parts/guess.hpp"
#include "algorithms/match/parts/point_line_registration.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench::matching {
namespace {

/// One step. The shift is along the reference's axes.
struct OptimalRoundRow {
  static constexpr std::string_view kName = "optimal_match_round";
  double walls = 0.0;  ///< sum of their weights
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;
  double misfit = 0.0;  ///< sum of weighted squared differences, in standard deviations
  static constexpr auto columns() {
    using R = OptimalRoundRow;
    return std::tuple{column("walls", &R::walls), column("x_m", &R::x_m), column("y_m", &R::y_m),
                      column("yaw_rad", &R::yaw_rad), column("misfit", &R::misfit)};
  }
};

constexpr int kMostRounds = 40;
constexpr int kMostDoubtfulRounds = 6;
constexpr double kStill = 1e-6;          // a step of a thousandth of the pose's standard deviation, squared
constexpr double kFewWalls = 1.0 / 3.0;  // of the scan with fewer lines: less in pairs puts a match in doubt
// Further starts where the first three are in doubt: turns of the guess, in its standard deviations.
constexpr double kTurns[] = {-2.0, 2.0, -4.0, 4.0, -6.0, 6.0};
// Of the pairs that speak for a position which the guess excludes against one which it allows: along a corridor with
// doors at equal distances, walls that fit by chance at one door fit together.
constexpr double kIndependent = 1.0 / 3.0;
// The least ratio of a motion's information to what errors of the normals give an open motion. For the two walls of a
// corridor that ratio is half a squared normal variable, which exceeds 10 once in 130 000 cases.
constexpr double kLeastRatio = 10.0;

class OptimalMatch final : public ScanMatcher {
 public:
  struct Params {
    double gate_m = 0.5;
    double guess_sigma_m = 0.1;
    double guess_sigma_deg = 3.0;
    double min_overlap = 0.3;
    static auto fields() {
      return std::tuple{
          field("gate_m", &Params::gate_m, between(1e-6, 1e6), "m", "farthest partner of a return at the start"),
          field("guess_sigma_m", &Params::guess_sigma_m, above(0), "m",
                "standard deviation of the guess per axis, where walls are paired by it alone"),
          field("guess_sigma_deg", &Params::guess_sigma_deg, above(0), "deg",
                "standard deviation of the guess's heading"),
          field("min_overlap", &Params::min_overlap, between(0, 1), "",
                "smallest share of returns with a partner; below it there is no match")};
    }
  };
  explicit OptimalMatch(const Params& p)
      : start_{.gate_m = p.gate_m,
               .keep = 0.9,
               .trim = 3.0,
               .by_noise = false,
               .min_overlap = p.min_overlap,
               .max_iterations = 20},
        guess_sigma_m_(p.guess_sigma_m),
        guess_sigma_rad_(radians(p.guess_sigma_deg)) {}

  Match match(const Observation& reference, const Observation& current, const Pose2& guessed,
              Trace& trace) const override {
    const Guess guess(guessed, guess_sigma_m_, guess_sigma_rad_);
    trace.stage(Stage::pre);
    const ReturnedPoints seen = returned_points(reference.scan), now = returned_points(current.scan);
    trace.stage(Stage::start);
    const bool points = seen.size() > 0 && now.size() > 0;
    const auto registered = [&](const Pose2& from) {
      return register_points_on_lines(seen, local_lines(seen), now, local_lines(now),
                                      Guess(from, guess_sigma_m_, guess_sigma_rad_), start_, trace);
    };
    const Match start = points ? registered(guessed) : Match{};
    const bool lost = points && start.status == Status::no_match;
    trace.stage(Stage::walls);
    const ScanMeasurements there = measurements(reference), here = measurements(current);
    const double lever = lever_of(now);
    const auto candidate = [&](const Start& from) { return by_walls(there, here, from, guess, lever, trace); };
    Candidate best{no_match(guessed)};
    if (!lost) best = more_probable(best, candidate({{guessed, guess.covariance()}, true}), guess);
    if (!lost && points) {
      const Pose2& pose = start.reference_from_current;
      const bool known = start.status == Status::converged;
      best = more_probable(best, candidate({{pose, known ? 4.0 * start.covariance : guess.covariance()}}), guess);
      best = more_probable(best, candidate({{pose, guess.covariance() / 100.0}}), guess);
    }
    const auto lines = static_cast<double>(std::min(there.lines.size(), here.lines.size()));
    if (in_doubt(best, guess, lines))
      for (const double turn : kTurns) {
        const Candidate other = candidate({{guess.turned(turn), 4.0 * guess.covariance()}});
        // Two parallel walls fit at many headings: what leaves a motion open confirms none that the guess excludes.
        if (other.match.status != Status::degenerate || !guess.excludes(other.match.reference_from_current))
          best = more_probable(best, other, guess);
      }
    if (!lost) return best.match;
    const bool found = best.match.status == Status::converged &&
                       registered(best.match.reference_from_current).status != Status::no_match;
    return found ? best.match : no_match(guessed);
  }

 private:
  struct Start {
    PoseBelief belief;
    bool doubt_of_each_wall = false;  ///< until the pairs are settled, see PoseDoubt
  };

  struct Candidate {
    Match match;
    // Logarithms of odds, together of this match against no pair at all at the guess.
    double by_pairs = 0.0;
    double by_guess = 0.0;
    double walls = 0.0;  ///< in pairs, sum of their weights

    double evidence(double share_of_pairs = 1.0) const { return share_of_pairs * by_pairs + by_guess; }
  };

  static const Candidate& more_probable(const Candidate& a, const Candidate& b, const Guess& guess) {
    if (b.match.status == Status::no_match) return a;
    if (a.match.status == Status::no_match) return b.evidence() >= 0.0 ? b : a;
    const bool only_one_excluded = guess.excludes_position(a.match.reference_from_current) !=
                                   guess.excludes_position(b.match.reference_from_current);
    const double share = only_one_excluded ? kIndependent : 1.0;
    return b.evidence(share) >= a.evidence(share) ? b : a;
  }

  /// `lines`: of the scan with fewer of them.
  static bool in_doubt(const Candidate& best, const Guess& guess, double lines) {
    const Match& match = best.match;
    return match.status == Status::no_match || match.status == Status::max_iterations ||
           guess.excludes(match.reference_from_current) || best.walls < kFewWalls * lines;
  }

  /// Pairs walls and steps in turn until neither changes: first with the doubt about the pose in the weights, so that
  /// walls known to millimetres count although the guess is off by centimetres, then without.
  static Candidate by_walls(const ScanMeasurements& reference, const ScanMeasurements& current, const Start& start,
                            const Guess& guess, double lever_m, Trace& trace) {
    Candidate result{{Status::max_iterations, guess.pose(), Eigen::Matrix3d::Zero()}};
    PoseBelief belief = start.belief;
    const Eigen::Matrix3d before = belief.covariance.inverse();
    Pose2& pose = belief.reference_from_current;
    std::vector<WallPair> walls;
    bool settled = false, doubtful = true;
    for (int round = 0; round < kMostRounds && !settled; ++round) {
      std::vector<WallPair> paired = pair_walls(reference.lines, current.lines, belief);
      if (paired.empty()) return {no_match(guess.pose())};
      const PoseDoubt doubt = doubtful ? PoseDoubt{belief.covariance, start.doubt_of_each_wall} : PoseDoubt{};
      WallEquations sum = wall_equations(paired, reference.lines, current.lines, pose, doubt);
      add_lone_returns(remainder(paired, reference, current), belief, doubt, sum);
      // What the walls know less well than the guess does is open too.
      if (!doubt.of_each_wall) sum.equations.by_chance += guess.covariance().inverse() / kLeastRatio;
      const Determined determined(sum.equations, lever_m, kLeastRatio);
      const Motion step = determined.solve(sum.equations.rhs);
      pose = moved(pose, step);
      const bool same = paired == walls && (doubtful ? step.head<2>().norm() < 1e-4 && std::fabs(step.z()) < 1e-5
                                                     : step.dot(sum.equations.matrix * step) < kStill);
      settled = same && !doubtful;
      const bool open = determined.rank() < 3;
      const Pose2 answer = open ? moved(guess.pose(), determined.project(motion_between(guess.pose(), pose))) : pose;
      const Status status = open ? Status::degenerate : settled ? Status::converged : Status::max_iterations;
      result = {{status, answer, determined.covariance(excess(sum, step))},
                sum.evidence,
                guess.log_density(answer),
                sum.walls};
      // Pairs that change in turn: the pose is not known better than they move it.
      if (status == Status::max_iterations) result.match.covariance += step * step.transpose();
      if (doubtful)
        belief.covariance = (before + sum.equations.matrix / contradiction(sum, step)).inverse();
      else if (!open)
        belief.covariance = result.match.covariance;
      walls = std::move(paired);
      doubtful = doubtful && !same && round + 1 < kMostDoubtfulRounds;
      trace.row(OptimalRoundRow{sum.walls, step.x(), step.y(), step.z(), sum.misfit});
    }
    return result;
  }

  /// Sum of the squared differences that are left after the step, in variances, and their degrees of freedom.
  struct Misfit {
    Misfit(const WallEquations& sum, const Motion& step)
        : value(sum.misfit - step.dot(sum.equations.rhs)), freedom(std::max(sum.coordinates - 3.0, 1.0)) {}
    double mean() const { return value / freedom; }
    double value;
    double freedom;
  };

  /// Mean squared difference; at least 1. Walls that contradict each other say that some are in wrong pairs, so that
  /// the pose is not known as well as their number says.
  static double contradiction(const WallEquations& sum, const Motion& step) {
    return std::max(Misfit(sum, step).mean(), 1.0);
  }

  /// The same, but 1 unless the differences exceed their mean by two standard deviations of chi-square. Then lines are
  /// not the walls that their covariances take them for, and the pose inherits it.
  static double excess(const WallEquations& sum, const Motion& step) {
    const Misfit misfit(sum, step);
    return misfit.value > misfit.freedom + 2.0 * std::sqrt(2.0 * misfit.freedom) ? misfit.mean() : 1.0;
  }

  RegistrationRules start_;
  double guess_sigma_m_;
  double guess_sigma_rad_;
};

SCANBENCH_REGISTER(ScanMatcher, OptimalMatch,
                   {.name = "optimal_match",
                    .summary = "pose of greatest likelihood under the sensor's noise, by the walls that both scans see",
                    .reference = "docs/algorithms/scan_matching.md; bound after Censi 2007, ICRA"});

}  // namespace
}  // namespace scanbench::matching
