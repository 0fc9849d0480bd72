// fuzzy_lines: fuzzy clustering of all points into a given number of lines, Borges & Aldon, "A split-and-merge
// segmentation algorithm for line extraction in 2-D range images", ICPR 2000, section 2.3.
#include <algorithm>

#include "algorithms/extract/parts/fuzzy_clustering.hpp"
#include "algorithms/extract/parts/groups.hpp"
#include "core/index.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench::extract {
namespace {

/// The objective after each half of an iteration.
struct CostRow {
  static constexpr std::string_view kName = "fuzzy_cost";
  double cost_m2 = 0.0;
  static constexpr auto columns() { return std::tuple{column("cost_m2", &CostRow::cost_m2)}; }
};

class FuzzyLinesModule final : public LineExtractor {
 public:
  struct Params {
    int lines = 4;
    double fuzzifier = 2.0;
    bool penalty = true;
    double rho_tolerance_m = 1e-3;
    double alpha_tolerance_rad = 1e-3;
    int max_iterations = 100;
    int min_points = 2;
    double min_length_m = 0.0;
    static auto fields() {
      return std::tuple_cat(
          std::tuple{field("lines", &Params::lines, between(1, 10000), "",
                           "number of lines C, which must be known in advance"),
                     field("fuzzifier", &Params::fuzzifier, above(1), "", "exponent m of the memberships"),
                     field("penalty", &Params::penalty, "include the distance to the cluster's centre (g of eq. 4)"),
                     field("rho_tolerance_m", &Params::rho_tolerance_m, at_least(0), "m",
                           "clustering stops when no line moves by more"),
                     field("alpha_tolerance_rad", &Params::alpha_tolerance_rad, between(0, 1.5), "rad",
                           "clustering stops when no line rotates by more"),
                     field("max_iterations", &Params::max_iterations, between(1, 100000), "",
                           "largest number of iterations of the clustering")},
          support_fields<Params>());
    }
  };

  explicit FuzzyLinesModule(const Params& p)
      : lines_(p.lines),
        options_{p.fuzzifier, p.penalty, p.rho_tolerance_m, p.alpha_tolerance_rad, p.max_iterations},
        rules_{p.min_points, p.min_length_m} {}

  ScanLines extract(const Scan& scan, Trace& trace) const override {
    trace.stage(Stage::pre);
    const ScanPoints in = valid_points(scan);
    trace.stage(Stage::segment);
    // Initial prototypes: runs of equally many points in scan order.
    const std::span<const Vec2> points(in.points);
    const std::size_t count = std::min(as_index(lines_), points.size());
    std::vector<FuzzyLine> initial;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t begin = i * points.size() / count;
      initial.push_back(prototype_of(points.subspan(begin, (i + 1) * points.size() / count - begin), {1.0, 0.0}));
    }
    const FuzzyLines fuzzy = fuzzy_lines(points, initial, options_);
    for (const double cost : fuzzy.costs) trace.row(CostRow{cost});
    trace.stage(Stage::fit);
    std::vector<int> group_of_point(points.size(), -1);
    for (std::size_t j = 0; j < points.size(); ++j) {
      std::size_t best = 0;
      for (std::size_t i = 1; i < count; ++i)
        if (fuzzy.membership(i, j) > fuzzy.membership(best, j)) best = i;
      group_of_point[j] = static_cast<int>(best);
    }
    return lines_of_groups(scan, in, group_of_point, static_cast<int>(count), Fit::tls, rules_);
  }

 private:
  int lines_;
  FuzzyOptions options_;
  SupportRules rules_;
};

SCANBENCH_REGISTER(
    LineExtractor, FuzzyLinesModule,
    {.name = "fuzzy_lines",
     .summary = "fuzzy clustering into a given number of lines",
     .reference = "Borges & Aldon, A split-and-merge segmentation algorithm for line extraction in 2-D range images, "
                  "ICPR 2000, section 2.3"});

}  // namespace
}  // namespace scanbench::extract
