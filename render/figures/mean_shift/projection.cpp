// Figure 4 of Lakaemper 2009: the segments of one sub-cluster are projected on its line, and projections that overlap
// become one segment.
#include <algorithm>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include "core/registry.hpp"
#include "render/figures/mean_shift/rows.hpp"
#include "render/figures/parts/style.hpp"

namespace scanbench::render {
namespace {

constexpr std::size_t kMostRows = 14;  // more have no room for their names
constexpr std::size_t kMostNames = 6;  // more would cover each other

const Stroke kSegmentStroke{kBlue, 1.1, Dash::solid};
const Stroke kLineStroke{kBlack, 0.8, Dash::dash_dot};
const Stroke kDropStroke{kGrey, 0.5, Dash::dotted};
const Stroke kProjectedMergeStroke{kVermillion, 2.4, Dash::solid};

/// The cluster's own frame: u along its line from the mode, v across.
struct LineFrame {
  Vec2 mode, along;
  Vec2 operator()(const Vec2& p) const { return {along.dot(p - mode), perpendicular(along).dot(p - mode)}; }
};

class Projection : public Figure {
 public:
  struct Params {
    std::string pipeline;
    int cluster = 0;
    double width_in = 4.6;
    static auto fields() {
      return std::tuple{field("pipeline", &Params::pipeline, kPipelineDoc),
                        field("cluster", &Params::cluster, at_least(0), "",
                              "sub-cluster of phase 2 to show, from 1; 0: the one that gives most lines"),
                        field("width_in", &Params::width_in, between(2, 20), "in", "width on paper")};
    }
  };
  explicit Projection(const Params& params) : params_(params) {}

  std::vector<std::string> trace_rows(std::string_view pipeline) const override {
    if (!shows(params_.pipeline, pipeline)) return {};
    return keys_of_mean_shift<mean_shift::JointSpaceRow, mean_shift::Mode2Row, mean_shift::ProjectionRow,
                              mean_shift::MergedRow>();
  }

  std::vector<NamedScene> draw(const FigureInput& input) const override {
    const auto rows = find_mean_shift(input, params_.pipeline);
    if (!rows) return {};
    Scene scene{.width_in = params_.width_in,
                .title = input.title + ": projection and overlap",
                .columns = 1,
                .box_aspect = 0.45};
    Panel plan{.title = "a) one sub-cluster and its line", .equal_aspect = false};
    plan.x.label = "along the line [m]", plan.y.label = "across [cm]";
    Panel overlap{.title = "b) projections and their unions", .equal_aspect = false};
    overlap.x.label = "along the line [m]";
    overlap.y.label = "", overlap.y.grid = false;

    std::string what = "there are no segments";
    if (const auto shown = shown_cluster(*rows)) {
      const CollinearCluster& cluster = rows->collinear[*shown];
      const LineFrame frame{*cluster.mode, {std::cos(cluster.theta_rad), std::sin(cluster.theta_rad)}};
      draw_plan(*rows, cluster, frame, plan);
      draw_overlap(cluster, frame, overlap);
      what = fmt::format("{} of sub-cluster {} on its line (direction {:.1f} deg) give {}",
                         counted(cluster.projections.size(), "segment"), *shown + 1, degrees(cluster.theta_rad),
                         counted(cluster.merged.size(), "line"));
    } else {
      add_note("no segments", plan), add_note("no segments", overlap);
      overlap.y.ticks = {{0.5, " "}};
    }
    scene.panels = {std::move(plan), std::move(overlap)};
    scene.legend = {{.text = "segments and their projections", .stroke = kSegmentStroke},
                    {.text = "cluster's line", .stroke = kLineStroke},
                    {.text = "projection", .stroke = kDropStroke},
                    {.text = "merged", .stroke = kProjectedMergeStroke}};
    return {{"projection",
             fmt::format("{}: {}; overlapping projections are united. Across is drawn larger than along.", input.title,
                         what),
             std::move(scene)}};
  }

 private:
  std::optional<std::size_t> shown_cluster(const MeanShiftRows& rows) const {
    const auto usable = [&](std::size_t c) {
      return c < rows.collinear.size() && rows.collinear[c].mode && !rows.collinear[c].projections.empty();
    };
    if (params_.cluster > 0) {
      const auto wanted = static_cast<std::size_t>(params_.cluster - 1);
      return usable(wanted) ? std::optional(wanted) : std::nullopt;
    }
    std::optional<std::size_t> best;
    const auto merit = [&](std::size_t c) {
      double length = 0.0;
      for (const Segment& s : rows.collinear[c].merged) length += s.length();
      return std::tuple(rows.collinear[c].merged.size(), rows.collinear[c].projections.size() <= kMostRows, length);
    };
    for (std::size_t c = 0; c < rows.collinear.size(); ++c)
      if (usable(c) && (!best || merit(c) > merit(*best))) best = c;
    return best;
  }

  static void draw_plan(const MeanShiftRows& rows, const CollinearCluster& cluster, const LineFrame& frame,
                        Panel& panel) {
    const auto in_cm = [&](const Vec2& p) { return Vec2(frame(p).x(), 100.0 * frame(p).y()); };
    Lines segments{.stroke = kSegmentStroke}, drops{.stroke = kDropStroke}, merged{.stroke = kProjectedMergeStroke};
    double low = INFINITY, high = -INFINITY;
    std::vector<Item> names;
    for (std::size_t i = 0; i < cluster.projections.size(); ++i) {
      const Segment& s = rows.pieces[cluster.projections[i].piece].segment;
      segments.segments.push_back({in_cm(s.a), in_cm(s.b)});
      for (const Vec2& end : {in_cm(s.a), in_cm(s.b)}) {
        drops.segments.push_back({end, {end.x(), 0.0}});
        low = std::min(low, end.x()), high = std::max(high, end.x());
      }
      if (cluster.projections.size() <= kMostNames)
        names.emplace_back(Text{.at = in_cm(s.midpoint()), .text = fmt::format("s{}", i + 1), .color = {0, 80, 125}});
    }
    for (const Segment& m : cluster.merged) merged.segments.push_back({in_cm(m.a), in_cm(m.b)});
    const double room = 0.06 * std::max(high - low, 1e-3);
    panel.items.emplace_back(
        Polyline{.points = {Vec2(low - room, 0.0), Vec2(high + room, 0.0)}, .stroke = kLineStroke});
    panel.items.emplace_back(std::move(merged));
    panel.items.emplace_back(std::move(drops));
    panel.items.emplace_back(std::move(segments));
    for (Item& name : names) panel.items.push_back(std::move(name));
    panel.x.range = {low - 1.5 * room, high + 1.5 * room};
  }

  /// Row by row from the top: each projection, then the merged lines.
  static void draw_overlap(const CollinearCluster& cluster, const LineFrame& frame, Panel& panel) {
    const std::size_t n = cluster.projections.size();
    Lines projections{.stroke = kSegmentStroke}, merged{.stroke = kProjectedMergeStroke};
    double low = INFINITY, high = -INFINITY;
    for (std::size_t i = 0; i < n; ++i) {
      const auto y = static_cast<double>(n - i);
      const Segment& s = cluster.projections[i].on_line;
      projections.segments.push_back({{frame(s.a).x(), y}, {frame(s.b).x(), y}});
      low = std::min({low, frame(s.a).x(), frame(s.b).x()}), high = std::max({high, frame(s.a).x(), frame(s.b).x()});
      if (n <= kMostRows) panel.y.ticks.emplace_back(y, fmt::format("s{}", i + 1));
    }
    for (const Segment& m : cluster.merged) merged.segments.push_back({{frame(m.a).x(), 0.0}, {frame(m.b).x(), 0.0}});
    if (n > kMostRows) panel.y.ticks.emplace_back(0.5 * static_cast<double>(n + 1), fmt::format("s1 .. s{}", n));
    panel.y.ticks.emplace_back(0.0, "merged");
    panel.items.emplace_back(std::move(projections));
    panel.items.emplace_back(std::move(merged));
    const double room = 0.09 * std::max(high - low, 1e-3);
    panel.x.range = {low - room, high + room};
    panel.y.range = {-0.8, static_cast<double>(n) + 0.8};
  }

  Params params_;
};

SCANBENCH_REGISTER(
    Figure, Projection,
    {.name = "projection",
     .summary =
         "the segments of one sub-cluster, their projections on its line, and the unions of overlapping projections",
     .reference = "Lakaemper 2009, figure 4"});

}  // namespace
}  // namespace scanbench::render
