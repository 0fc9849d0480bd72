// smf: split-and-merge fuzzy (SMF) line extraction, Borges & Aldon, "A split-and-merge segmentation algorithm for line
// extraction in 2-D range images", ICPR 2000, section 3. docs/algorithms/smf.md lists what the paper leaves open.
#include "algorithms/extract/parts/groups.hpp"
#include "algorithms/extract/smf/phases.hpp"
#include "core/index.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench::extract {
namespace {

class Smf final : public LineExtractor {
 public:
  struct Params {
    double sigma_max_m = 0.05;
    double fuzzifier = 2.0;
    bool penalty = true;
    bool penalty_in_dispersion = false;
    SmfInitialisation initialisation = SmfInitialisation::scan_order;
    double max_gap_m = 0.0;
    int min_points = 2;
    double min_length_m = 0.0;
    double rho_tolerance_m = 1e-3;
    double alpha_tolerance_rad = 1e-3;
    int max_iterations = 100;
    static auto fields() {
      using I = SmfInitialisation;
      return std::tuple_cat(
          std::tuple{
              field("sigma_max_m", &Params::sigma_max_m, above(0), "m",
                    "largest dispersion of a line; the paper uses the sensor's sigma, 1.2 sigma breaks fewer walls"),
              field("fuzzifier", &Params::fuzzifier, above(1), "", "exponent m of the memberships"),
              field("penalty", &Params::penalty,
                    "include the distance to the cluster's centre in the clustering (g of eq. 4)"),
              field("penalty_in_dispersion", &Params::penalty_in_dispersion,
                    "include g in the dispersion too, as eq. 11 can be read; breaks walls into many pieces"),
              choice("initialisation", &Params::initialisation,
                     {{I::scan_order, "scan_order"}, {I::principal_axis, "principal_axis"}, {I::farthest, "farthest"}},
                     "how a line is halved before it is clustered into two"),
              field("max_gap_m", &Params::max_gap_m, at_least(0), "m",
                    "largest gap along a fused line; 0 disables the limit"),
              field("rho_tolerance_m", &Params::rho_tolerance_m, at_least(0), "m",
                    "clustering stops when no line moves by more"),
              field("alpha_tolerance_rad", &Params::alpha_tolerance_rad, between(0, 1.5), "rad",
                    "clustering stops when no line rotates by more"),
              field("max_iterations", &Params::max_iterations, between(1, 100000), "",
                    "largest number of iterations of one clustering")},
          support_fields<Params>());
    }
  };

  explicit Smf(const Params& p)
      : options_{p.sigma_max_m,
                 {p.fuzzifier, p.penalty, p.rho_tolerance_m, p.alpha_tolerance_rad, p.max_iterations},
                 p.penalty_in_dispersion,
                 p.initialisation,
                 p.max_gap_m},
        rules_{p.min_points, p.min_length_m} {}

  ScanLines extract(const Scan& scan, Trace& trace) const override {
    trace.stage(Stage::pre);
    const ScanPoints in = valid_points(scan);
    trace.stage(Stage::segment);
    std::vector<SmfLine> lines = smf_split(in.points, options_, trace);
    lines = smf_merge(in.points, std::move(lines), options_, trace);
    trace.stage(Stage::fit);
    std::vector<int> group_of_point(in.size(), -1);
    for (std::size_t k = 0; k < lines.size(); ++k)
      for (const int j : lines[k].support) group_of_point[as_index(j)] = static_cast<int>(k);
    return lines_of_groups(scan, in, group_of_point, static_cast<int>(lines.size()), Fit::tls, rules_);
  }

 private:
  SmfOptions options_;
  SupportRules rules_;
};

SCANBENCH_REGISTER(
    LineExtractor, Smf,
    {.name = "smf",
     .summary = "split and merge with fuzzy clustering into two lines (SMF)",
     .reference = "Borges & Aldon, A split-and-merge segmentation algorithm for line extraction in 2-D range images, "
                  "ICPR 2000, section 3"});

}  // namespace
}  // namespace scanbench::extract
