// Figures 6 and 9 of Lakaemper 2009: the segments given, and the merged ones with those that cleaning erased; below
// them a detail, because both look alike on a map of a building.
#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/registry.hpp"
#include "render/figures/mean_shift/rows.hpp"
#include "render/figures/parts/before_after.hpp"
#include "render/figures/parts/clusters.hpp"
#include "render/figures/parts/frames.hpp"
#include "render/figures/parts/style.hpp"
#include "render/figures/parts/view_box.hpp"
#include "render/figures/parts/visible_points.hpp"

namespace scanbench::render {
namespace {

const Stroke kStageGivenStroke{kBlue, 0.6, Dash::solid};
const Stroke kStageMergedStroke{kBlack, 1.0, Dash::solid};
const Stroke kStageErasedStroke{kVermillion, 1.0, Dash::solid};
constexpr double kStageDotPt = 0.7, kDetailDotPt = 1.6;
constexpr std::size_t kDetailLines = 60;  // that the detail shows at most, if it can be that small
constexpr int kMostHalvings = 4;          // to a twenty-fourth of the map: a door is still a door

/// What a panel draws, from back to front.
struct Stage {
  std::vector<Vec2> points;
  std::vector<Segment> erased, lines;
  Stroke stroke;
};

/// Lines of `merged` that are not in the map, and are not part of a longer line of it either.
std::vector<Segment> erased_lines(const std::vector<Segment>& merged, const std::vector<Segment>& map) {
  constexpr double kLargestShift = 0.05;  // of a line that is joined to another one [m]
  std::vector<Segment> erased;
  for (const Segment& line : merged) {
    const double shift = std::min(0.1 * line.length(), kLargestShift);
    if (std::ranges::none_of(map, [&](const Segment& kept) { return distance(line.midpoint(), kept) <= shift; }))
      erased.push_back(line);
  }
  return erased;
}

/// The part of a stage in a window.
Stage inside(const Window& window, const Stage& stage) {
  Stage part{.points = {}, .erased = {}, .lines = {}, .stroke = stage.stroke};
  std::ranges::copy_if(stage.points, std::back_inserter(part.points), [&](auto& p) { return window.contains(p); });
  std::ranges::copy_if(stage.erased, std::back_inserter(part.erased), [&](auto& s) { return window.is_near(s); });
  std::ranges::copy_if(stage.lines, std::back_inserter(part.lines), [&](auto& s) { return window.is_near(s); });
  return part;
}

/// The part that is magnified, of the shape of the whole map: around most erased lines, or most given ones, and so
/// small that lines beside each other can be seen as such.
std::optional<Window> detail_of(const Stage& before, const Stage& after, double aspect) {
  const std::vector<Segment>& around = after.erased.empty() ? before.lines : after.erased;
  std::vector<Vec2> places;
  for (const Segment& line : around) places.push_back(line.midpoint());
  std::optional<Window> window;
  double side = extent_of(before.lines) / 3.0;
  for (int k = 0; k < kMostHalvings; ++k, side *= 0.5) {
    window = fullest_window(places, side);
    if (!window) return window;
    window->aspect = aspect;
    const auto held = std::ranges::count_if(before.lines, [&](const Segment& s) { return window->is_near(s); });
    if (held <= static_cast<std::ptrdiff_t>(kDetailLines)) break;
  }
  return window;
}

class MergeStages : public Figure {
 public:
  struct Params {
    std::string pipeline;
    static auto fields() {
      return std::tuple{field("pipeline", &Params::pipeline, "pipeline to show; empty: the first one that has a map")};
    }
  };
  explicit MergeStages(const Params& params) : params_(params) {}

  std::vector<std::string> trace_rows(std::string_view pipeline) const override {
    if (!shows(params_.pipeline, pipeline)) return {};
    return {key_of<mean_shift::MergedRow>(kMergeSlot)};
  }

  std::string why_nothing(const FigureInput&) const override { return "no pipeline has finished"; }

  std::vector<NamedScene> draw(const FigureInput& input) const override {
    const BeforeAfter both = before_after(input, params_.pipeline);
    if (both.named == nullptr) return {};
    const std::vector<Segment> merged = merged_before_cleaning(*both.named);
    const bool cleaned = !merged.empty() && merged != both.map;
    constexpr std::size_t kAll = 10'000'000;
    const Stage before{.points = all_points(input.recording, both.world_from_sensor, kAll),
                       .erased = {},
                       .lines = both.all_given(),
                       .stroke = kStageGivenStroke};
    const Stage after{.points = before.points,
                      .erased = cleaned ? erased_lines(merged, both.map) : std::vector<Segment>(),
                      .lines = both.map,
                      .stroke = kStageMergedStroke};
    const std::string of_merging = cleaned ? fmt::format(" ({} before cleaning)", merged.size()) : "";

    Scene scene{.width_in = kDoubleColumnIn, .columns = 2};
    scene.title = fmt::format("{}: {}", input.title, both.named->pipeline);
    Panel whole;
    set_view(before.points.empty() ? ends_of(before.lines) : before.points, {}, whole);
    scene.panels = {
        panel_of("a) given: " + counted(before.lines.size(), "line"), whole, before, kStageDotPt),
        panel_of("b) merged: " + counted(after.lines.size(), "line") + of_merging, whole, after, kStageDotPt)};
    if (const auto window = detail_of(before, after, aspect_of(whole))) {
      for (Panel& panel : scene.panels) panel.items.emplace_back(window->outline());
      Panel part;
      window->set_ranges(part);
      scene.panels.push_back(panel_of("c) part of a, magnified", part, inside(*window, before), kDetailDotPt));
      scene.panels.push_back(panel_of("d) part of b, magnified", part, inside(*window, after), kDetailDotPt));
    }
    add_legend_entries(scene);
    return {{"merge_stages",
             fmt::format("{}: a) {} given to {} and b) {} in the map{}; c) and d) the framed part of both.",
                         input.title, counted(before.lines.size(), "line"), both.named->pipeline,
                         counted(after.lines.size(), "line"), of_merging),
             std::move(scene)}};
  }

 private:
  static double aspect_of(const Panel& panel) {
    if (!panel.x.range || !panel.y.range) return 1.0;
    const auto length = [](const auto& range) { return range->second - range->first; };
    return std::clamp(length(panel.y.range) / length(panel.x.range), 0.3, 2.5);
  }

  /// Points are drawn only where lines do not hide them.
  static Panel panel_of(const std::string& title, Panel panel, const Stage& stage, double dot_pt) {
    panel.title = title;
    panel.tell_outside = "point";
    std::vector<Segment> lines = stage.lines;
    lines.insert(lines.end(), stage.erased.begin(), stage.erased.end());
    const Scene alone{.width_in = 0.5 * kDoubleColumnIn, .panels = {panel}};
    if (seen_beside(stage.points, lines, stage.stroke.width_pt, alone))
      panel.items.emplace_back(
          Points{.points = thinned(stage.points, kPointBudget / 4), .color = kFaintPoints, .size_pt = dot_pt});
    if (!stage.erased.empty())
      panel.items.emplace_back(
          Lines{.segments = thinned(stage.erased, kSegmentBudget / 6), .stroke = kStageErasedStroke});
    panel.items.emplace_back(Lines{.segments = thinned(stage.lines, kSegmentBudget / 6), .stroke = stage.stroke});
    if (lines.empty()) add_note("no lines", panel);
    return panel;
  }

  static void add_legend_entries(Scene& scene) {
    const auto has_points = [](const Panel& panel) {
      return std::ranges::any_of(panel.items, [](const Item& item) { return std::holds_alternative<Points>(item); });
    };
    if (std::ranges::any_of(scene.panels, has_points))
      scene.legend.push_back(
          {.text = "scan points", .marker = Marker::dot, .marker_color = kFaintPoints, .marker_size_pt = 2.0});
    for (const auto& [text, stroke] :
         {std::pair("lines given", kStageGivenStroke), std::pair("lines of the map", kStageMergedStroke),
          std::pair("erased by cleaning", kStageErasedStroke)})
      if (draws(scene, stroke)) scene.legend.push_back({.text = text, .stroke = stroke});
  }

  static std::vector<Segment> merged_before_cleaning(const NamedResult& named) {
    std::vector<Segment> merged;
    if (named.trace == nullptr) return merged;
    for (const auto& row : rows_of<mean_shift::MergedRow>(*named.trace, kMergeSlot))
      merged.push_back({{row.x1_m, row.y1_m}, {row.x2_m, row.y2_m}});
    return merged;
  }

  Params params_;
};

SCANBENCH_REGISTER(
    Figure, MergeStages,
    {.name = "merge_stages",
     .summary = "the lines given, and the lines they are merged to with those that cleaning erases; a detail of both",
     .reference = "Lakaemper 2009, figures 6 and 9"});

}  // namespace
}  // namespace scanbench::render
