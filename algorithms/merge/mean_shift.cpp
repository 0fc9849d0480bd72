// mean_shift: simultaneous multi-line-segment merging with mean-shift clustering (R. Lakaemper, "Simultaneous
// multi-line-segment merging for robot mapping using mean shift clustering", IROS 2009). docs/algorithms/mean_shift.md
// lists the departures from the text, with reasons.
//
// Results for difficult input: no lines give an empty map with the status converged. Lines that are not finite, have no
// length or reach beyond 1e9 m are dropped (label -1); if none is left, the status is degenerate. A sigma that would
// cut the lines into more than 10 million pieces, or for which a coordinate exceeds 1e8 sigma, is a ParamError. The map
// does not depend on the order of the lines, nor on which end of a line is called a: every line of the map has the
// direction (cos t, sin t) with t in [0, pi). Its covariances are zero, because mean shift does not estimate them.
#include <algorithm>
#include <array>
#include <cmath>

#include "algorithms/merge/mean_shift/interval_merge.hpp"
#include "algorithms/merge/mean_shift/map_cleanup.hpp"
#include "algorithms/merge/mean_shift/modes.hpp"
#include "algorithms/merge/mean_shift/phases.hpp"
#include "algorithms/merge/mean_shift/single_phase.hpp"
#include "algorithms/merge/mean_shift/trace.hpp"
#include "algorithms/merge/parts/joint_space.hpp"
#include "core/contracts/mean_shift_trace.hpp"
#include "core/index.hpp"
#include "core/modules.hpp"
#include "core/number_text.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

using merge::Clustering;
using merge::DraftLine;
using merge::Kernels;
using merge::Piece;

enum class Phases { two, single };
enum class Labelling { linked, strict };

class MeanShift final : public SegmentMerger {
 public:
  struct Params {
    double sigma_m = 0.20;
    double h_deg_per_m = 0.0;
    Phases phases = Phases::two;
    double split_length_sigma = 2.0;
    Labelling labelling = Labelling::linked;
    double epsilon_sigma = 0.0;
    double epsilon2 = 0.0;
    double ridge_dip = 0.2;
    double sigma_x_sigma = 2.0;
    double sigma_y_sigma = 0.1;
    double kernel2_factor = 1.0;
    merge::Kernel2 kernel2 = merge::Kernel2::rotated;
    double cutoff = 4.0;
    bool accelerate = true;
    bool capture = true;
    double merge_gap_m = 0.0;
    bool join = true;
    double join_angle_deg = 5.0;
    double join_deviation_sigma = 0.1;
    double join_gap_sigma = 0.5;
    bool trim = false;
    double trim_sigma = 1.0;
    bool erase_unsupported = true;
    double min_length_sigma = 2.5;
    double min_points_per_m = 25.0;
    double support_distance_sigma = 0.25;

    static auto fields() {
      return std::tuple{
          field("sigma_m", &Params::sigma_m, above(0), "m",
                "size of the smallest significant detail; all other lengths are multiples of it"),
          field("h_deg_per_m", &Params::h_deg_per_m, at_least(0), "deg/m",
                "bandwidth: the difference of direction that counts as one metre; 0: 10 deg per sigma_m"),
          choice("phases", &Params::phases, {{Phases::two, "two"}, {Phases::single, "single"}},
                 "two: by direction, then by collinearity; single: both at once, which is less robust"),
          field("split_length_sigma", &Params::split_length_sigma, above(0), "sigma_m",
                "largest length of a piece; longer lines are first cut into equal pieces"),
          choice("labelling", &Params::labelling, {{Labelling::linked, "linked"}, {Labelling::strict, "strict"}},
                 "linked: modes no farther apart than the pieces of a wall are one cluster; strict: only modes that "
                 "coincide are"),
          field("epsilon_sigma", &Params::epsilon_sigma, at_least(0), "sigma_m",
                "largest distance of linked modes in phase 1; 0: split_length_sigma (linked), 0.25 (strict)"),
          field("epsilon2", &Params::epsilon2, at_least(0), "",
                "largest distance of linked modes in phase 2, in units of sigma_x along and sigma_y across; 0: 1 "
                "(linked), 0.25 (strict)"),
          field("ridge_dip", &Params::ridge_dip, between(0, 1), "",
                "linked labelling: modes of one ridge are one cluster if the density between them falls by at most "
                "this share; 0: only the distance decides"),
          field("sigma_x_sigma", &Params::sigma_x_sigma, above(0), "sigma_m",
                "standard deviation of the kernel of phase 2 along the cluster's direction"),
          field("sigma_y_sigma", &Params::sigma_y_sigma, above(0), "sigma_m",
                "standard deviation of the kernel of phase 2 across the cluster's direction"),
          field("kernel2_factor", &Params::kernel2_factor, above(0), "",
                "factor of both variances in phase 2: 1 as the text defines them, 2 as in eqs 5 and 6"),
          choice("kernel2", &Params::kernel2,
                 {{merge::Kernel2::rotated, "rotated"}, {merge::Kernel2::printed, "printed"}},
                 "rotated: the kernel is long along the cluster's direction; printed: with the sign of b as in eq. 6, "
                 "it is long along the mirrored direction (to show the difference)"),
          field("cutoff", &Params::cutoff, between(3, 6), "",
                "number of standard deviations at which kernels are cut off during climbs; modes are polished with "
                "6.5"),
          field("accelerate", &Params::accelerate,
                "Newton steps where mean shift is slow; false: eq. 1 alone until its shift is 1e-3 of the kernel"),
          field("capture", &Params::capture, "end a climb as soon as it is next to a known mode"),
          field("merge_gap_m", &Params::merge_gap_m, at_least(0), "m",
                "largest gap across which the projected segments of one cluster are united"),
          field("join", &Params::join, "unite abutting lines of the merged map; the paper has no such step"),
          field("join_angle_deg", &Params::join_angle_deg, between(0, 45), "deg",
                "largest difference of direction of joined lines"),
          field("join_deviation_sigma", &Params::join_deviation_sigma, at_least(0), "sigma_m",
                "largest distance of the end points from the joined line"),
          field("join_gap_sigma", &Params::join_gap_sigma, at_least(0), "sigma_m", "largest gap that a join closes"),
          field("trim", &Params::trim, "shorten lines that overshoot an intersection"),
          field("trim_sigma", &Params::trim_sigma, at_least(0), "sigma_m", "longest overshoot that is removed"),
          field("erase_unsupported", &Params::erase_unsupported,
                "erase short lines with few scan points near them (if points are given)"),
          field("min_length_sigma", &Params::min_length_sigma, at_least(0), "sigma_m",
                "lines of at least this length are never erased"),
          field("min_points_per_m", &Params::min_points_per_m, at_least(0), "1/m",
                "smallest number of supporting points per metre of a short line"),
          field("support_distance_sigma", &Params::support_distance_sigma, at_least(0), "sigma_m",
                "largest distance of a supporting scan point from its line"),
      };
    }
  };

  explicit MeanShift(const Params& params) : p_(params), kernels_(kernels_of(params)) {}

  MergeResult merge(const MergeInput& input, Trace& trace) const override;

 private:
  static Kernels kernels_of(const Params& p);
  std::vector<DraftLine> merge_clusters(std::span<const Piece> pieces, const Clustering& last,
                                        std::span<const double> directions, Trace& trace) const;

  Params p_;
  Kernels kernels_;
};

Kernels MeanShift::kernels_of(const Params& p) {
  const bool strict = p.labelling == Labelling::strict;
  const auto set_or = [](double value, double derived) { return value > 0 ? value : derived; };
  const Kernels k{
      .sigma_m = p.sigma_m,
      .h_rad_per_m = p.h_deg_per_m > 0 ? radians(p.h_deg_per_m) : radians(10.0) / p.sigma_m,
      .sigma_x_m = p.sigma_x_sigma * p.sigma_m,
      .sigma_y_m = p.sigma_y_sigma * p.sigma_m,
      .factor = p.kernel2_factor,
      .form = p.kernel2,
      .epsilon1_m = set_or(p.epsilon_sigma, strict ? 0.25 : p.split_length_sigma) * p.sigma_m,
      .epsilon2 = set_or(p.epsilon2, strict ? 0.25 : 1.0),
      .ridge_dip = strict ? 0.0 : p.ridge_dip,
      .cutoff = p.cutoff,
      .accelerate = p.accelerate,
      .capture = p.capture,
  };
  const double widest_deg = degrees(kPi / merge::min_period(p.cutoff));
  if (degrees(k.h_rad_per_m * k.sigma_m) > widest_deg)
    throw ParamError("h_deg_per_m", "h_deg_per_m * sigma_m = " + number_text(degrees(k.h_rad_per_m * k.sigma_m)) +
                                        " deg is more than " + number_text(widest_deg) +
                                        " deg: so wide a kernel reaches perpendicular directions, where the distance "
                                        "of eq. 4 has a kink and the density no gradient");
  return k;
}

/// For each cluster, the mean of the directions to which its members converged (section IV.C).
std::vector<double> cluster_directions_of(const Clustering& clustering) {
  std::vector<double> result, directions;
  for (const std::vector<int>& members : merge::members_of(clustering.cluster, clustering.clusters)) {
    directions.clear();
    for (const int k : members) directions.push_back(clustering.end[as_index(k)].z());
    result.push_back(merge::mean_direction(directions));
  }
  return result;
}

std::vector<DraftLine> MeanShift::merge_clusters(std::span<const Piece> pieces, const Clustering& last,
                                                 std::span<const double> directions, Trace& trace) const {
  std::vector<DraftLine> drafts;
  const auto members = merge::members_of(last.cluster, last.clusters);
  for (std::size_t c = 0; c < members.size(); ++c) {
    std::vector<Segment> segments;
    Vec2 mean = Vec2::Zero();  // the mode M, relative to the first member's end
    const Vec2 origin = last.end[as_index(members[c].front())].head<2>();
    for (const int k : members[c]) {
      segments.push_back(pieces[as_index(k)].segment);
      mean += last.end[as_index(k)].head<2>() - origin;
    }
    const Vec2 mode = origin + mean / static_cast<double>(members[c].size());
    const double theta = directions[c];
    for (merge::MergedSegment& merged : merge::merge_on_line(segments, mode, theta, p_.merge_gap_m)) {
      DraftLine draft{merged.segment, {}, static_cast<int>(c)};
      for (const int k : merged.contributors) draft.pieces.push_back(members[c][as_index(k)]);
      drafts.push_back(std::move(draft));
    }
    merge::trace_collinear_cluster(static_cast<int>(c), mode, theta, members[c], pieces, kernels_, trace);
  }
  return drafts;
}

/// For each line, the index with the largest share of its length; of equal shares the lowest index, -1 if there is
/// none.
class LargestShare {
 public:
  explicit LargestShare(std::size_t lines) : shares_(lines) {}
  void add(std::size_t line, int index, double length) {
    if (index < 0) return;
    for (auto& [known, sum] : shares_[line]) {
      if (known != index) continue;
      sum += length;
      return;
    }
    shares_[line].emplace_back(index, length);
  }
  std::vector<int> winners() const {
    std::vector<int> result;
    for (const auto& line : shares_) {
      const auto best = std::max_element(line.begin(), line.end(), [](const auto& a, const auto& b) {
        const double slack = 1e-9 * std::max(a.second, b.second);  // the lengths of equal pieces differ by rounding
        return std::abs(a.second - b.second) > slack ? a.second < b.second : a.first > b.first;
      });
      result.push_back(best == line.end() ? -1 : best->first);
    }
    return result;
  }

 private:
  std::vector<std::vector<std::pair<int, double>>> shares_;
};

MergeResult MeanShift::merge(const MergeInput& input, Trace& trace) const {
  MergeResult result;
  const std::size_t n = input.lines.size();
  result.labels.assign(n, -1);
  result.cluster1.assign(n, -1);
  result.cluster2.assign(n, -1);

  trace.stage(Stage::split);
  const merge::JointSpace space = merge::split_lines(input.lines, p_.sigma_m, p_.split_length_sigma * p_.sigma_m);
  const std::vector<Piece>& pieces = space.pieces;
  if (pieces.empty()) {
    if (n > 0) result.status = Status::degenerate;
    trace.row(mean_shift::CountsRow{.lines = static_cast<int>(n)});
    return result;
  }
  const bool recording = trace.recording();
  merge::trace_joint_space(pieces, kernels_, trace);

  trace.stage(Stage::phase1);
  const Clustering first = p_.phases == Phases::two ? merge::cluster_directions(pieces, kernels_, recording)
                                                    : merge::cluster_in_one_phase(pieces, kernels_, recording);
  const std::vector<double> directions1 = cluster_directions_of(first);
  merge::trace_trajectories<1>(first, trace);
  merge::trace_ends(first, trace);

  trace.stage(Stage::phase2);
  Clustering second;
  if (p_.phases == Phases::two) {
    second = merge::cluster_collinear(pieces, first.cluster, directions1, kernels_, recording);
    merge::trace_trajectories<2>(second, trace);
  }
  const Clustering& last = p_.phases == Phases::two ? second : first;
  if (!first.converged || !last.converged) result.status = Status::max_iterations;

  trace.stage(Stage::merge);
  std::vector<DraftLine> drafts = merge_clusters(pieces, last, cluster_directions_of(last), trace);
  const std::size_t merged = drafts.size();
  merge::trace_merged(drafts, trace);

  trace.stage(Stage::post);
  if (p_.join)
    drafts = merge::join_neighbours(std::move(drafts), {.angle_rad = radians(p_.join_angle_deg),
                                                        .deviation_m = p_.join_deviation_sigma * p_.sigma_m,
                                                        .gap_m = p_.join_gap_sigma * p_.sigma_m});
  if (p_.trim) merge::trim_overshoots(drafts, p_.trim_sigma * p_.sigma_m);
  if (p_.erase_unsupported && !input.points.empty()) {
    const std::vector<bool> lacking = merge::lacks_support(drafts, input.points,
                                                           {.distance_m = p_.support_distance_sigma * p_.sigma_m,
                                                            .min_length_m = p_.min_length_sigma * p_.sigma_m,
                                                            .min_points_per_m = p_.min_points_per_m});
    std::size_t i = 0;
    std::erase_if(drafts, [&](const DraftLine&) { return lacking[i++]; });
  }

  std::vector<int> map_line_of(pieces.size(), -1);
  for (std::size_t d = 0; d < drafts.size(); ++d)
    for (const int k : drafts[d].pieces) map_line_of[as_index(k)] = static_cast<int>(d);
  for (std::size_t k = 0; k < pieces.size(); ++k)
    trace.row(mean_shift::ClusterRow{static_cast<int>(k), first.cluster[k], last.cluster[k], map_line_of[k]});
  const auto label_of_lines = [&](const std::vector<int>& label_of_pieces) {
    LargestShare shares(n);
    for (std::size_t k = 0; k < pieces.size(); ++k)
      shares.add(pieces[k].line, label_of_pieces[k], pieces[k].segment.length());
    return shares.winners();
  };
  result.labels = label_of_lines(map_line_of);
  result.cluster1 = label_of_lines(first.cluster);
  result.cluster2 = label_of_lines(last.cluster);

  for (const DraftLine& draft : drafts) {
    MapLine line;
    line.segment = draft.segment;
    line.members = 0;
    double points = 0.0;
    std::vector<std::size_t> sources;
    for (const int k : draft.pieces) {
      const Piece& piece = pieces[as_index(k)];
      const MapLine& source = input.lines[piece.line];
      points += source.points * piece.segment.length() / source.segment.length();
      sources.push_back(piece.line);
    }
    std::sort(sources.begin(), sources.end());
    sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
    for (const std::size_t i : sources) line.members += input.lines[i].members;
    line.points = static_cast<int>(std::lround(points));
    const auto& [a, b] = line.segment;
    trace.row(mean_shift::IntervalRow{a.x(), a.y(), b.x(), b.y()});
    result.map.lines.push_back(line);
  }
  trace.row(mean_shift::CountsRow{.lines = static_cast<int>(n),
                                  .pieces = static_cast<int>(pieces.size()),
                                  .clusters1 = first.clusters,
                                  .clusters2 = last.clusters,
                                  .merged = static_cast<int>(merged),
                                  .map_lines = static_cast<int>(drafts.size())});
  return result;
}

SCANBENCH_REGISTER(
    SegmentMerger, MeanShift,
    {.name = "mean_shift",
     .summary =
         "clusters segments with mean shift, by direction and place and then by collinearity, and merges clusters",
     .reference = "Lakaemper, Simultaneous Multi-Line-Segment Merging for Robot Mapping using Mean Shift Clustering, "
                  "IROS 2009"});

}  // namespace
}  // namespace scanbench
