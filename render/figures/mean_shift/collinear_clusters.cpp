// Figure 3 of Lakaemper 2009: phase 2. One cluster of phase 1 with the kernel, its sub-clusters, all modes, and the
// merged lines.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/registry.hpp"
#include "render/figures/mean_shift/rows.hpp"
#include "render/figures/parts/clusters.hpp"
#include "render/figures/parts/style.hpp"
#include "render/figures/parts/view_box.hpp"

namespace scanbench::render {
namespace {

const Stroke kKernelStroke{kVermillion, 1.3, Dash::solid};
const Points kModeStyle{.marker = Marker::diamond, .color = kBlack, .size_pt = 4.6, .filled = false};

class CollinearClusters : public Figure {
 public:
  struct Params {
    std::string pipeline;
    int cluster = 0;
    static auto fields() {
      return std::tuple{field("pipeline", &Params::pipeline, kPipelineDoc),
                        field("cluster", &Params::cluster, at_least(0), "",
                              "cluster of phase 1 to show, as numbered in direction_clusters; 0: the one that phase 2 "
                              "splits into most parts")};
    }
  };
  explicit CollinearClusters(const Params& params) : params_(params) {}

  std::vector<std::string> trace_rows(std::string_view pipeline) const override {
    if (!shows(params_.pipeline, pipeline)) return {};
    return keys_of_mean_shift<mean_shift::JointSpaceRow, mean_shift::ClusterRow, mean_shift::Mode2Row,
                              mean_shift::Kernel2Row, mean_shift::IntervalRow>();
  }

  std::vector<NamedScene> draw(const FigureInput& input) const override {
    const auto rows = find_mean_shift(input, params_.pipeline);
    if (!rows) return {};
    const ClusteredSegments collinear = rows->by_collinearity();
    const int shown = shown_cluster(*rows);
    std::vector<std::size_t> members;
    std::set<int> parts;
    for (std::size_t k = 0; k < rows->pieces.size(); ++k)
      if (shown >= 0 && rows->pieces[k].cluster1 == shown) {
        members.push_back(k);
        parts.insert(rows->pieces[k].cluster2);
      }

    Scene scene{.width_in = kDoubleColumnIn, .title = input.title + ": mean shift, phase 2", .columns = 2};
    scene.panels = {kernel_panel(*rows, members, shown), parts_panel(collinear, *rows, members, parts.size()),
                    modes_panel(collinear, *rows), map_panel(*rows)};
    scene.legend = {{.text = "centres of segments", .marker = Marker::dot, .marker_size_pt = 2.6},
                    {.text = "kernel of phase 2, one standard deviation", .stroke = kKernelStroke},
                    {.text = "modes",
                     .marker = kModeStyle.marker,
                     .marker_color = kModeStyle.color,
                     .marker_size_pt = kModeStyle.size_pt,
                     .marker_filled = kModeStyle.filled},
                    {.text = "other segments", .stroke = Stroke{kTruthUnderlay, 0.7, Dash::solid}}};
    return {{"collinear_clusters",
             fmt::format(
                 "{}: phase 2. a) segments of one cluster of phase 1 with their centres and the kernel K2, long along "
                 "the cluster's direction; b) its sub-clusters of collinear segments; c) modes of all {}; d) the {} "
                 "merged from them.",
                 input.title, counted(collinear.clusters(), "sub-cluster"), counted(rows->map.size(), "line")),
             std::move(scene)}};
  }

 private:
  /// The index of the shown cluster, from 0; -1: none.
  int shown_cluster(const MeanShiftRows& rows) const {
    if (params_.cluster > 0) return params_.cluster - 1;
    std::map<int, std::set<int>> parts;
    std::map<int, std::size_t> size;
    for (const MergePiece& piece : rows.pieces)
      if (piece.cluster1 >= 0) {
        parts[piece.cluster1].insert(piece.cluster2);
        ++size[piece.cluster1];
      }
    int best = -1;
    for (const auto& [cluster, of] : parts)
      if (best < 0 || std::pair(of.size(), size[cluster]) > std::pair(parts[best].size(), size[best])) best = cluster;
    return best;
  }

  static Lines underlay(const MeanShiftRows& rows) {
    return {.segments = thinned(rows.segments(), kSegmentBudget / 4), .stroke = {kTruthUnderlay, 0.5, Dash::solid}};
  }

  /// A square around the members and the kernel.
  static void set_window(const MeanShiftRows& rows, const std::vector<std::size_t>& members,
                         const std::optional<Ellipse>& kernel, Panel& panel) {
    std::vector<Segment> shown;
    shown.reserve(members.size());
    for (const std::size_t k : members) shown.push_back(rows.pieces[k].segment);
    if (kernel) {
      const Vec2 along = kernel->semi_axes.x() * Vec2(std::cos(kernel->angle_rad), std::sin(kernel->angle_rad));
      shown.push_back({kernel->center + along, kernel->center - along});
    }
    if (const auto square = square_around(shown)) square->set_ranges(panel);
  }

  /// The kernel of the sub-cluster with most of the members.
  static std::optional<Ellipse> kernel_of(const MeanShiftRows& rows, const std::vector<std::size_t>& members) {
    std::map<int, int> count;
    for (const std::size_t k : members) ++count[rows.pieces[k].cluster2];
    const auto most = std::ranges::max_element(count, {}, [](const auto& entry) { return entry.second; });
    if (most == count.end() || most->first < 0 || static_cast<std::size_t>(most->first) >= rows.collinear.size())
      return std::nullopt;
    return rows.collinear[static_cast<std::size_t>(most->first)].kernel;
  }

  static Panel kernel_panel(const MeanShiftRows& rows, const std::vector<std::size_t>& members, int shown) {
    Panel panel{
        .title = shown < 0 ? "a) one cluster of phase 1"
                           : fmt::format("a) cluster {} of phase 1: {}", shown + 1, counted(members.size(), "piece"))};
    auto kernel = kernel_of(rows, members);
    set_window(rows, members, kernel, panel);
    panel.items.emplace_back(underlay(rows));
    Lines lines{.stroke = {kBlue, 0.9, Dash::solid}};
    Points centres{.color = kBlack, .size_pt = 2.6};
    for (const std::size_t k : members) {
      lines.segments.push_back(rows.pieces[k].segment);
      centres.points.push_back(rows.pieces[k].segment.midpoint());
    }
    panel.items.emplace_back(std::move(lines));
    if (kernel) {
      kernel->stroke = {kWhite, kKernelStroke.width_pt + 1.6, Dash::solid};
      panel.items.emplace_back(*kernel);
      kernel->stroke = kKernelStroke;
      panel.items.emplace_back(*kernel);
    }
    panel.items.emplace_back(std::move(centres));
    if (members.empty()) add_note("no segments", panel);
    return panel;
  }

  static Panel parts_panel(const ClusteredSegments& collinear, const MeanShiftRows& rows,
                           const std::vector<std::size_t>& members, std::size_t parts) {
    Panel panel{.title = "b) its " + counted(parts, "sub-cluster")};
    set_window(rows, members, kernel_of(rows, members), panel);
    panel.items.emplace_back(underlay(rows));
    std::vector<Segment> segments;
    std::vector<int> part;
    std::map<int, int> number;  // from 0, in the order of their places along the list
    Points modes = kModeStyle;
    for (const std::size_t k : members) {
      const int cluster = rows.pieces[k].cluster2;
      const auto [entry, is_new] = number.try_emplace(cluster, static_cast<int>(number.size()));
      segments.push_back(rows.pieces[k].segment);
      part.push_back(cluster < 0 ? -1 : entry->second);
      if (!is_new || cluster < 0 || static_cast<std::size_t>(cluster) >= rows.collinear.size()) continue;
      if (const auto& mode = rows.collinear[static_cast<std::size_t>(cluster)].mode) modes.points.push_back(*mode);
    }
    const ClusteredSegments of_cluster(std::move(segments), std::move(part));
    of_cluster.add_segments(1.1, kSegmentBudget / 4, panel);
    panel.items.emplace_back(std::move(modes));
    of_cluster.add_numbers(panel);
    if (collinear.segments().empty()) add_note("no segments", panel);
    return panel;
  }

  static Panel modes_panel(const ClusteredSegments& collinear, const MeanShiftRows& rows) {
    Panel panel{.title = "c) modes of all " + counted(collinear.clusters(), "sub-cluster")};
    collinear.add_segments(0.6, kSegmentBudget / 4, panel);
    Points modes = kModeStyle;
    for (const CollinearCluster& cluster : rows.collinear)
      if (cluster.mode) modes.points.push_back(*cluster.mode);
    if (modes.points.size() > 100) modes.size_pt = 2.4;  // larger ones would hide the segments
    panel.items.emplace_back(std::move(modes));
    if (collinear.segments().empty()) add_note("no segments", panel);
    return panel;
  }

  static Panel map_panel(const MeanShiftRows& rows) {
    Panel panel{.title = "d) merged: " + counted(rows.map.size(), "line")};
    panel.items.emplace_back(underlay(rows));
    panel.items.emplace_back(Lines{.segments = rows.map, .stroke = {kBlack, 1.1, Dash::solid}});
    if (rows.map.empty()) add_note("no lines", panel);
    return panel;
  }

  Params params_;
};

SCANBENCH_REGISTER(
    Figure, CollinearClusters,
    {.name = "collinear_clusters",
     .summary = "phase 2: one cluster with the kernel's ellipse, its sub-clusters, all modes and the merged lines",
     .reference = "Lakaemper 2009, figure 3"});

}  // namespace
}  // namespace scanbench::render
