// borges2000: into how many lines each wall is broken and how well these fit it (Borges & Aldon, "A split-and-merge
// segmentation algorithm for line extraction in 2-D range images", ICPR 2000, section 4).
//
// The paper leaves four things open. Lines are compared in the world frame, because its tables cannot be reproduced
// otherwise. The difference of two lines is taken on the circle and across rho = 0. N and eta are averaged over the
// scans in which the wall has a line: the tables contain N = 1.00. The errors are pooled over the valid lines: no
// other average gives line 3 of LT in the tables.
#include <algorithm>
#include <map>

#include "core/error.hpp"
#include "core/index.hpp"
#include "core/registry.hpp"
#include "core/special_values.hpp"
#include "metrics/rows.hpp"

namespace scanbench::metrics {
namespace {

enum class ComparisonFrame { world, sensor };

/// The averages of one wall over the scans.
struct WallTally {
  Mean lines;        ///< N_l over the scans in which it is at least 1
  Mean validity;     ///< eta_l over the same scans
  Mean rho_error;    ///< over valid lines
  Mean alpha_error;  ///< over valid lines
  Mean missed;       ///< over the scans that see the wall: 1 if it has no line in the scan
};

/// N_l and M_l of one scan.
struct ScanTally {
  int points = 0;
  int lines = 0;
  int valid = 0;
};

class Borges2000 : public MetricFamily {
 public:
  struct Params {
    ComparisonFrame frame = ComparisonFrame::world;
    int min_points = 2;
    double rho_tolerance_m = 0.5;
    double alpha_tolerance_deg = 20.0;
    static auto fields() {
      return std::tuple{
          choice("frame", &Params::frame, {{ComparisonFrame::world, "world"}, {ComparisonFrame::sensor, "sensor"}},
                 "frame in which (rho, alpha) of lines and walls are compared"),
          field("min_points", &Params::min_points, at_least(1), "", "lines with fewer support points are ignored"),
          field("rho_tolerance_m", &Params::rho_tolerance_m, above(0), "m", "largest error in rho of a valid line"),
          field("alpha_tolerance_deg", &Params::alpha_tolerance_deg, between(0.001, 90), "deg",
                "largest error in alpha of a valid line")};
    }
  };

  explicit Borges2000(const Params& params) : params_(params) {}

  std::vector<MetricDescription> describe() const override {
    using enum Direction;
    return {
        {"n_lines", "lines per wall", "", lower_is_better, 0.05,
         "lines that a wall is broken into, mean over the scans in which it has one; subject: the wall, or mean over "
         "walls"},
        share({"eta", "valid lines", "", higher_is_better, 0.02,
               "share of valid lines among a wall's lines, mean over the scans in which it has a line"}),
        {"eps_rho", "rho error", "m", lower_is_better, 0.005, "mean absolute error in rho of a wall's valid lines"},
        {"eps_alpha", "alpha error", "deg", lower_is_better, 0.2,
         "mean absolute error in alpha of a wall's valid lines"},
        share({"missed", "walls missed", "", lower_is_better, 0.02,
               "share of the scans with enough points on a wall in which it has no line"}),
        {"spurious", "spurious lines", "", lower_is_better, 0.0, "lines without a support point on a wall"}};
  }

  bool applies(const MetricInput& input) const override { return has_beam_truth(input); }

  std::vector<MetricRow> evaluate(const MetricInput& input) const override {
    SCANBENCH_ASSERT(applies(input));
    const std::vector<Wall>& walls = input.truth->walls;
    std::vector<WallTally> tallies(walls.size());
    std::int64_t considered = 0;
    std::int64_t spurious = 0;
    for (std::size_t f = 0; f < input.observed.frames.size(); ++f) add_scan(input, f, tallies, considered, spurious);

    Rows rows(describe());
    const std::vector<std::string> subjects = wall_subjects(walls);
    const auto add_metric = [&](std::string_view metric, Mean WallTally::*member) {
      Mean over_walls;
      for (std::size_t w = 0; w < walls.size(); ++w) {
        const Mean& mean = tallies[w].*member;
        rows.add(metric, subjects[w], mean);
        if (mean.count() > 0) over_walls.add(mean.value());
      }
      rows.add(metric, "mean", over_walls);
    };
    add_metric("n_lines", &WallTally::lines);
    add_metric("eta", &WallTally::validity);
    add_metric("eps_rho", &WallTally::rho_error);
    add_metric("eps_alpha", &WallTally::alpha_error);
    add_metric("missed", &WallTally::missed);
    rows.add("spurious", kAll, number(spurious), considered);
    return rows.take();
  }

 private:
  void add_scan(const MetricInput& input, std::size_t f, std::vector<WallTally>& tallies, std::int64_t& considered,
                std::int64_t& spurious) const {
    const Truth& truth = *input.truth;
    const ScanLines& found = input.result.lines[f];
    const Scan scan = input.observed.scan(f);
    const auto beams = as_index(scan.beams());
    SCANBENCH_ASSERT(found.labels.size() == beams);

    std::vector<ScanTally> scan_tally(truth.walls.size());
    std::vector<std::map<int, int>> origins(found.lines.size());  // per line: wall -> support points from it
    std::vector<int> support(found.lines.size(), 0);
    for (std::size_t i = 0; i < beams; ++i) {
      const int wall = truth.wall_ids[f * beams + i];
      const int line = found.labels[i];
      if (wall >= 0 && scan.valid(static_cast<int>(i))) ++scan_tally[as_index(wall)].points;
      if (line < 0) continue;
      ++support[as_index(line)];
      if (wall >= 0) ++origins[as_index(line)][wall];
    }

    for (std::size_t k = 0; k < found.lines.size(); ++k) {
      // An extractor that gives a break point to both of its lines can label it only once; its own count is then
      // larger.
      if (std::max(support[k], found.lines[k].points) < params_.min_points) continue;
      ++considered;
      if (origins[k].empty()) {
        ++spurious;
        continue;
      }
      const auto [wall, error] = most_similar_wall(truth, f, found.lines[k].line, origins[k]);
      ScanTally& tally = scan_tally[wall];
      ++tally.lines;
      if (error.rho <= params_.rho_tolerance_m && error.alpha <= radians(params_.alpha_tolerance_deg)) {
        ++tally.valid;
        tallies[wall].rho_error.add(error.rho);
        tallies[wall].alpha_error.add(degrees(error.alpha));
      }
    }

    for (std::size_t w = 0; w < scan_tally.size(); ++w) {
      const ScanTally& tally = scan_tally[w];
      if (tally.lines > 0) {
        tallies[w].lines.add(tally.lines);
        tallies[w].validity.add(static_cast<double>(tally.valid) / tally.lines);
      }
      if (tally.points >= params_.min_points) tallies[w].missed.add(tally.lines == 0 ? 1.0 : 0.0);
    }
  }

  /// The wall that the line belongs to, chosen from the walls of its support points: the nearest one in (rho, alpha),
  /// each scaled by its tolerance. Ties go to the wall with more points, then to the lower index.
  std::pair<std::size_t, LineDifference> most_similar_wall(const Truth& truth, std::size_t f, const PolarLine& line,
                                                           const std::map<int, int>& origins) const {
    const Pose2& world_from_sensor = truth.world_from_sensor[f];
    const bool in_world = params_.frame == ComparisonFrame::world;
    const PolarLine seen = in_world ? transform(world_from_sensor, line) : line;
    std::size_t best_wall = 0;
    LineDifference best_error{};
    double best = kInf;
    int best_points = 0;
    for (const auto& [wall, points] : origins) {
      const Segment& s = truth.walls[as_index(wall)].segment;
      const PolarLine in_world_frame = line_through(s.a, s.b);
      const LineDifference error =
          line_difference(seen, in_world ? in_world_frame : transform(world_from_sensor.inverse(), in_world_frame));
      const double rho = error.rho / params_.rho_tolerance_m;
      const double alpha = error.alpha / radians(params_.alpha_tolerance_deg);
      const double dissimilarity = rho * rho + alpha * alpha;
      if (best_points == 0 || dissimilarity < best || (dissimilarity == best && points > best_points)) {
        best_wall = as_index(wall);
        best_error = error;
        best = dissimilarity;
        best_points = points;
      }
    }
    return {best_wall, best_error};
  }

  Params params_;
};

SCANBENCH_REGISTER(MetricFamily, Borges2000,
                   {.name = "borges2000",
                    .summary = "per wall: lines that it is broken into, share of valid lines, errors in rho and alpha",
                    .reference = "Borges & Aldon 2000, section 4"});

}  // namespace
}  // namespace scanbench::metrics
