// ransac: tests lines through random pairs of points. The line with the largest support is kept, its points are
// removed, and the search is repeated until no line has enough support. Fischler & Bolles 1981; Nguyen et al.,
// Autonomous Robots 23, 2007, the algorithm "RANSAC".
//
// The second point of a pair is drawn near the first in scan order, because distant points are rarely on one wall. The
// support of a hypothesis is its largest stretch of points without a gap. Random draws depend on the seed alone.
#include <algorithm>
#include <cmath>

#include "algorithms/extract/parts/consensus.hpp"
#include "algorithms/extract/parts/covariance.hpp"
#include "core/index.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"
#include "core/rng.hpp"

namespace scanbench {
namespace {

using namespace extract;

class Ransac final : public LineExtractor {
 public:
  struct Params {
    int seed = 1;
    int trials = 100;
    double neighbourhood = 0.1;
    double max_gap_m = 0.3;
    int max_lines = 100;
    double sigmas = 3.0;
    double floor_m = 0.01;
    int min_points = 8;
    double min_length_m = 0.1;

    static auto fields() {
      return std::tuple_cat(
          std::tuple{
              field("seed", &Params::seed, between(0, 2147483647), "", "seed of the random pairs"),
              field("trials", &Params::trials, between(1, 10000), "", "number of pairs tried per line"),
              field("neighbourhood", &Params::neighbourhood, between(0.001, 1), "",
                    "largest distance between the points of a pair in scan order, as a share of the remaining points")},
          consensus_fields<Params>());
    }
  };

  explicit Ransac(const Params& params) : params_(params) {}

  ScanLines extract(const Scan& scan, Trace& trace) const override {
    trace.stage(Stage::pre);
    const ScanPoints points = valid_points(scan);
    const std::vector<double> tolerance = tolerances(scan, points, {params_.sigmas, params_.floor_m});
    trace.stage(Stage::segment);
    std::vector<int> group(points.size(), -1);
    const auto needed = as_index(std::max(2, params_.min_points));
    int lines = 0;
    for (; lines < params_.max_lines; ++lines) {
      std::vector<int> best = best_of_trials(points, tolerance, group, lines);
      if (best.size() < needed) break;
      best = refined_support(points.points, tolerance, group, std::move(best), params_.max_gap_m);
      for (const int i : best) group[as_index(i)] = lines;
    }
    trace.stage(Stage::post);
    ScanLines result =
        lines_of_groups(scan, points, group, lines, Fit::tls, {params_.min_points, params_.min_length_m});
    add_covariances(scan, points, result);
    return result;
  }

 private:
  std::vector<int> best_of_trials(const ScanPoints& points, std::span<const double> tolerance,
                                  std::span<const int> group, int line) const {
    std::vector<int> free;
    for (std::size_t i = 0; i < group.size(); ++i)
      if (group[i] < 0) free.push_back(static_cast<int>(i));
    std::vector<int> best;
    const int n = static_cast<int>(free.size());
    if (n < 2) return best;
    const int reach = std::clamp(static_cast<int>(params_.neighbourhood * n), 1, n - 1);
    CounterRng rng(static_cast<std::uint64_t>(params_.seed), RngStream::resampling, static_cast<std::uint32_t>(line));
    const auto below = [&](int limit) { return std::min(limit - 1, static_cast<int>(rng.uniform() * limit)); };
    for (int trial = 0; trial < params_.trials; ++trial) {
      const int first = below(n);
      const int second = (first + 1 + below(reach)) % n;
      const Vec2& a = points.points[as_index(free[as_index(first)])];
      const Vec2 d = points.points[as_index(free[as_index(second)])] - a;
      const double length = d.norm();
      if (!(length > 0)) continue;
      const Vec2 normal = perpendicular(d / length);
      std::vector<int> support =
          largest_support(points.points, tolerance, group, normal, normal.dot(a), params_.max_gap_m);
      if (support.size() > best.size()) best = std::move(support);
    }
    return best;
  }

  Params params_;
};

SCANBENCH_REGISTER(LineExtractor, Ransac,
                   {.name = "ransac",
                    .summary = "RANSAC: the line through a random pair of points with the largest support, repeatedly",
                    .reference = "Fischler & Bolles 1981; Nguyen et al. 2007, Autonomous Robots 23, algorithm RANSAC"});

}  // namespace
}  // namespace scanbench
