// Point-to-line ICP after Censi, "An ICP variant using a point-to-line metric", ICRA 2008.
// docs/algorithms/scan_matching.md, section 2.
//
// Departures. The line at a reference return is fitted to as many neighbours as the noise demands; the paper draws it
// through two of them, which do not determine a direction at 5 cm noise and 5 cm between returns. Residuals are
// weighted by the noise across the line. The current return is moved onto its own line first, so that both scans are
// treated alike and the errors of lines near corners cancel. Near the pose, pairs beyond a multiple of the median
// residual are left out; before that, and throughout in the paper, a share of the pairs is. A result that the guess
// hardly allows counts only along motions that the pairs know well (conclusion() in parts/pairs.hpp).
#include "algorithms/match/parts/point_line_registration.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench::matching {
namespace {

class PlIcp final : public ScanMatcher {
 public:
  struct Params {
    double gate_m = 0.5;
    double keep = 0.9;
    double trim = 4.5;
    double guess_sigma_m = 0.1;
    double guess_sigma_deg = 3.0;
    double min_overlap = 0.3;
    int max_iterations = 30;
    static auto fields() {
      return std::tuple{
          field("gate_m", &Params::gate_m, between(1e-6, 1e6), "m", "farthest partner of a return"),
          field("keep", &Params::keep, between(0, 1), "",
                "share of the pairs, those nearest to their lines, that counts until the pose is near"),
          field("trim", &Params::trim, between(1, 1e6), "",
                "then pairs count up to so many times the median distance from the line, both in standard deviations"),
          field("guess_sigma_m", &Params::guess_sigma_m, above(0), "m",
                "standard deviation of the guess per axis; a result outside of 95 % of it is held against it"),
          field("guess_sigma_deg", &Params::guess_sigma_deg, above(0), "deg",
                "standard deviation of the guess's heading"),
          field("min_overlap", &Params::min_overlap, between(0, 1), "",
                "smallest share of returns with a partner; below it there is no match"),
          field("max_iterations", &Params::max_iterations, between(1, 1e6), "", "iterations at most")};
    }
  };
  explicit PlIcp(const Params& p)
      : rules_{p.gate_m, p.keep, p.trim, true, p.min_overlap, p.max_iterations, true},
        guess_sigma_m_(p.guess_sigma_m),
        guess_sigma_rad_(radians(p.guess_sigma_deg)) {}

  Match match(const Observation& reference, const Observation& current, const Pose2& guess,
              Trace& trace) const override {
    trace.stage(Stage::pre);
    const ReturnedPoints seen = returned_points(reference.scan), now = returned_points(current.scan);
    const std::vector<LocalLine> lines = local_lines(seen);
    trace.stage(Stage::iterate);
    return register_points_on_lines(seen, lines, now, local_lines(now), Guess(guess, guess_sigma_m_, guess_sigma_rad_),
                                    rules_, trace);
  }

 private:
  RegistrationRules rules_;
  double guess_sigma_m_;
  double guess_sigma_rad_;
};

SCANBENCH_REGISTER(ScanMatcher, PlIcp,
                   {.name = "plicp",
                    .summary = "point-to-line ICP: returns on the lines through their partners' neighbours",
                    .reference = "Censi 2008, An ICP variant using a point-to-line metric, ICRA"});

}  // namespace
}  // namespace scanbench::matching
