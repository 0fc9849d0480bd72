// Virtual scans: force field simulation with an additional scan that contains hypotheses about lines and rectangles of
// the map, detected anew in every iteration. Lakaemper, "Augmenting sparse laser scans with virtual scans to improve
// the performance of alignment algorithms", 2010, sections 4 and 5. docs/algorithms/virtual_scans.md has the rules and
// their cost.
#include "algorithms/align/ffs/hypotheses.hpp"
#include "algorithms/align/ffs/simulation.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

using namespace align::ffs;

class VirtualScans final : public Aligner {
 public:
  struct Params {
    double resample_m = 0.1;
    double sigma_start_m = 0.6;
    double sigma_end_m = 0.05;
    int cooling_iterations = 60;
    int max_iterations = 200;
    double step_start = 10.0;
    double step_end = 1.0;
    double cut_sigmas = 4.0;
    double soft_sigmas = 0.05;
    double line_weight = 1.0;
    double rectangle_weight = 1.0;
    int max_lines = 8;
    double min_votes = 40.0;
    double line_min_certainty = 0.3;
    double rectangle_min_certainty = 0.5;
    double rectangle_min_side_m = 0.5;
    double rectangle_misfit = 0.25;
    double merge_distance_m = 0.2;
    double merge_gap_m = 1.5;

    static auto fields() {
      return std::tuple_cat(
          schedule_fields<Params>(),
          std::tuple{field("line_weight", &Params::line_weight, between(0, 1e3), "",
                           "weight of a virtual point of the most certain line; a real point has 1; 0: no lines"),
                     field("rectangle_weight", &Params::rectangle_weight, between(0, 1e3), "",
                           "weight of a virtual point of a rectangle of certainty 1; 0: no rectangles"),
                     field("max_lines", &Params::max_lines, between(0, 1000), "", "lines at most"),
                     field("min_votes", &Params::min_votes, at_least(1), "", "fewest points that make a line"),
                     field("line_min_certainty", &Params::line_min_certainty, between(0, 1), "",
                           "smallest ratio of the votes of a line to those of the strongest"),
                     field("rectangle_min_certainty", &Params::rectangle_min_certainty, between(0, 1), "",
                           "smallest certainty of a rectangle: seen share of its perimeter times squareness"),
                     field("rectangle_min_side_m", &Params::rectangle_min_side_m, above(0), "m",
                           "smallest distance of two parallel sides"),
                     field("rectangle_misfit", &Params::rectangle_misfit, between(0, 1), "",
                           "largest relative difference of a side from the distance of the other two, and of centres"),
                     field("merge_distance_m", &Params::merge_distance_m, at_least(0), "m",
                           "segments of several scans are one side if their distance across is at most this"),
                     field("merge_gap_m", &Params::merge_gap_m, at_least(0), "m",
                           "and their gap along is at most this, such as a door")});
    }
  };

  explicit VirtualScans(const Params& p) : schedule_(schedule_of(p)) {
    rules_.lines = {p.resample_m, p.line_min_certainty, p.min_votes, p.max_lines};
    rules_.rectangles.min_side_m = p.rectangle_min_side_m;
    rules_.rectangles.misfit = p.rectangle_misfit;
    rules_.rectangles.min_certainty = p.rectangle_min_certainty;
    rules_.prototypes.distance_m = p.merge_distance_m;
    rules_.prototypes.gap_m = p.merge_gap_m;
    rules_.line_weight = p.line_weight;
    rules_.rectangle_weight = p.rectangle_weight;
    rules_.resample_m = p.resample_m;
  }

  Alignment align(std::span<const Observation> scans, std::span<const Pose2> initial, Trace& trace) const override {
    HypothesisJournal journal(rules_.resample_m);
    const auto hypothesize = [&](const CurrentMap& map, Trace& listener) {
      std::vector<Hypothesis> hypotheses = hypotheses_of(map, rules_);
      journal.follow(map, hypotheses, listener);
      return plotted(hypotheses, rules_);
    };
    return simulate(scans, initial, schedule_, hypothesize, trace);
  }

 private:
  Schedule schedule_;
  HypothesisRules rules_;
};

SCANBENCH_REGISTER(
    Aligner, VirtualScans,
    {.name = "virtual_scans",
     .summary = "force field simulation with hypothetical lines and rectangles of the map as one more, weighted scan",
     .reference = "Lakaemper 2010, sections 4 and 5"});

}  // namespace
}  // namespace scanbench
