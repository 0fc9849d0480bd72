// hough: Hough transform. Every point votes for the lines through it on a grid of (angle, distance). The cell with the
// most votes becomes a line, the votes of its points are removed, and the search is repeated. Duda & Hart 1972, "Use of
// the Hough transformation to detect lines and curves in pictures"; Nguyen et al., Autonomous Robots 23, 2007, the
// algorithm "HT".
//
// Half the votes of a cell's two neighbours in distance are added to its own, so that a line near the border of two
// cells is not lost. The support is the largest stretch of points without a gap; the line is refitted to it.
#include <algorithm>
#include <cmath>

#include "algorithms/extract/parts/consensus.hpp"
#include "algorithms/extract/parts/covariance.hpp"
#include "core/geometry/portable_math.hpp"
#include "core/index.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

using namespace extract;

constexpr int kMaxCellsAcross = 4096;  // the step grows if the farthest return needs more

// Votes over (angle in [0, pi), signed distance).
class Accumulator {
 public:
  Accumulator(int angles, double step_m, double reach_m) : step_m_(step_m) {
    if (2.0 * reach_m / step_m_ > kMaxCellsAcross - 4) step_m_ = 2.0 * reach_m / (kMaxCellsAcross - 4);
    zero_ = static_cast<int>(std::ceil(reach_m / step_m_)) + 1;  // one more cell on both sides, for the neighbours
    across_ = 2 * zero_ + 1;
    for (int k = 0; k < angles; ++k) {
      const auto [s, c] = portable::sincos(k * kPi / angles);
      normals_.emplace_back(c, s);
    }
    votes_.assign(normals_.size() * as_index(across_), 0);
  }

  void vote(const Vec2& p, int weight) {
    for (std::size_t k = 0; k < normals_.size(); ++k) {
      const double rho = normals_[k].x() * p.x() + normals_[k].y() * p.y();
      const int cell = zero_ + static_cast<int>(std::floor(rho / step_m_ + 0.5));
      votes_[k * as_index(across_) + as_index(cell)] += weight;
    }
  }

  struct Peak {
    int twice_votes = 0;
    Vec2 normal{1, 0};
    double offset = 0.0;
  };
  /// Of equal cells the lowest angle wins, then the lowest distance.
  Peak peak() const {
    Peak best;
    for (std::size_t k = 0; k < normals_.size(); ++k) {
      const int* row = votes_.data() + k * as_index(across_);
      for (int c = 1; c + 1 < across_; ++c) {
        const int twice = row[c - 1] + 2 * row[c] + row[c + 1];
        if (twice > best.twice_votes) best = {twice, normals_[k], (c - zero_) * step_m_};
      }
    }
    return best;
  }
  double step_m() const { return step_m_; }

 private:
  double step_m_;
  int zero_ = 0;
  int across_ = 0;
  std::vector<Vec2> normals_;
  std::vector<int> votes_;
};

class Hough final : public LineExtractor {
 public:
  struct Params {
    int angles = 180;
    double step_m = 0.03;
    double max_gap_m = 0.3;
    int max_lines = 100;
    double sigmas = 3.0;
    double floor_m = 0.01;
    int min_points = 8;
    double min_length_m = 0.1;

    static auto fields() {
      return std::tuple_cat(
          std::tuple{field("angles", &Params::angles, between(4, 1440), "",
                           "number of directions of the grid over half a turn"),
                     field("step_m", &Params::step_m, between(1e-4, 10), "m",
                           "distance between cells; increased if the farthest return would need more than 4096 cells")},
          consensus_fields<Params>());
    }
  };

  explicit Hough(const Params& params) : params_(params) {}

  ScanLines extract(const Scan& scan, Trace& trace) const override {
    trace.stage(Stage::pre);
    const ScanPoints points = valid_points(scan);
    const std::vector<double> tolerance = tolerances(scan, points, {params_.sigmas, params_.floor_m});
    std::vector<int> group(points.size(), -1);
    int lines = 0;
    trace.stage(Stage::segment);
    if (points.size() > 0) lines = group_points(points, tolerance, group);
    for (int& g : group) g = g == kVotesRemoved ? -1 : g;
    trace.stage(Stage::post);
    ScanLines result =
        lines_of_groups(scan, points, group, lines, Fit::tls, {params_.min_points, params_.min_length_m});
    add_covariances(scan, points, result);
    return result;
  }

 private:
  static constexpr int kVotesRemoved = 1 << 30;  // votes are removed, but no line has the point

  int group_points(const ScanPoints& points, std::span<const double> tolerance, std::vector<int>& group) const {
    double reach = 0.0;
    for (const Vec2& p : points.points) reach = std::max(reach, p.norm());
    Accumulator votes(params_.angles, params_.step_m, reach);
    for (const Vec2& p : points.points) votes.vote(p, 1);

    // The true line may differ from the centre of its cell by half a distance step, and by half an angle step times the
    // range.
    std::vector<double> wide(tolerance.begin(), tolerance.end());
    for (std::size_t i = 0; i < wide.size(); ++i)
      wide[i] += votes.step_m() + points.points[i].norm() * kPi / (2 * params_.angles);

    const auto needed = as_index(std::max(2, params_.min_points));
    int lines = 0;
    for (std::size_t rounds = 0; rounds < points.size() && lines < params_.max_lines; ++rounds) {
      const Accumulator::Peak peak = votes.peak();
      if (peak.twice_votes < static_cast<int>(needed)) break;
      const std::vector<int> rough =
          largest_support(points.points, wide, group, peak.normal, peak.offset, params_.max_gap_m);
      if (rough.empty()) break;
      const LineFit fit = fit_line(moments_of(points.points, rough));
      std::vector<int> support;
      if (!fit.degenerate)
        support = largest_support(points.points, tolerance, group, fit.normal, fit.offset, params_.max_gap_m);
      if (!support.empty())
        support = refined_support(points.points, tolerance, group, std::move(support), params_.max_gap_m);
      const bool enough = support.size() >= needed;
      // The votes of a peak without enough support are also removed; otherwise the search would find it again in every
      // round.
      for (const int i : enough ? support : rough) {
        group[as_index(i)] = enough ? lines : kVotesRemoved;
        votes.vote(points.points[as_index(i)], -1);
      }
      if (enough) ++lines;
    }
    return lines;
  }

  Params params_;
};

SCANBENCH_REGISTER(
    LineExtractor, Hough,
    {.name = "hough",
     .summary = "Hough transform: the cell of angle and distance with the most votes becomes a line, repeatedly",
     .reference = "Duda & Hart 1972; Nguyen et al. 2007, Autonomous Robots 23, algorithm HT"});

}  // namespace
}  // namespace scanbench
