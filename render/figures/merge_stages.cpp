// Figures 6 and 9 of Lakaemper 2009: the segments given, the merged ones, and those left after cleaning.
#include <fmt/format.h>

#include "core/registry.hpp"
#include "render/figures/mean_shift/rows.hpp"
#include "render/figures/parts/before_after.hpp"
#include "render/figures/parts/clusters.hpp"
#include "render/figures/parts/frames.hpp"
#include "render/figures/parts/style.hpp"
#include "render/figures/parts/view_box.hpp"

namespace scanbench::render {
namespace {

const Stroke kStageGivenStroke{kBlue, 0.5, Dash::solid};
const Stroke kStageMergedStroke{kBlack, 1.0, Dash::solid};

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

  std::vector<NamedScene> draw(const FigureInput& input) const override {
    const BeforeAfter both = before_after(input, params_.pipeline);
    if (both.named == nullptr) return {};
    const std::vector<Vec2> points = all_points(input.recording, both.world_from_sensor, kPointBudget / 3);
    const std::vector<Segment> given = both.all_given();
    const std::vector<Vec2> ends = ends_of(given);

    Scene scene;
    const auto add = [&](const std::string& title, const std::vector<Segment>& segments, const Stroke& stroke) {
      Panel panel{.title = fmt::format("{}) {}: {}", static_cast<char>('a' + scene.panels.size()), title,
                                       counted(segments.size(), "line")),
                  .tell_outside = "point"};
      panel.items.emplace_back(Points{.points = points, .color = kFaintPoints, .size_pt = 0.7});
      panel.items.emplace_back(Lines{.segments = thinned(segments, kSegmentBudget / 3), .stroke = stroke});
      set_view(points.empty() ? ends : points, {}, panel);
      if (segments.empty()) add_note("no lines", panel);
      scene.panels.push_back(std::move(panel));
    };
    add("given", given, kStageGivenStroke);
    const std::vector<Segment> merged = merged_before_cleaning(*both.named);
    if (!merged.empty() && merged != both.map) add("merged", merged, kStageMergedStroke);
    const bool cleaned = scene.panels.size() == 2;
    add(cleaned ? "after cleaning" : "merged", both.map, kStageMergedStroke);

    const Scene looks = small_multiples(scene.panels.size());
    scene.width_in = kDoubleColumnIn;
    scene.columns = looks.columns;
    scene.share_axes = scene.scale_bar = true;
    scene.title = fmt::format("{}: {}", input.title, both.named->pipeline);
    if (!points.empty())
      scene.legend.push_back(
          {.text = "scan points", .marker = Marker::dot, .marker_color = kFaintPoints, .marker_size_pt = 2.0});
    scene.legend.push_back({.text = "lines given", .stroke = Stroke{kBlue, 0.9, Dash::solid}});
    scene.legend.push_back({.text = "lines of the map", .stroke = kStageMergedStroke});
    return {{"merge_stages",
             fmt::format("{}: {} given to {} and {} in the map{}.", input.title, counted(given.size(), "line"),
                         both.named->pipeline, counted(both.map.size(), "line"),
                         cleaned ? fmt::format(" ({} before cleaning)", merged.size()) : ""),
             std::move(scene)}};
  }

 private:
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
     .summary = "the lines given, the lines they are merged to, and those left after cleaning, over the scan points",
     .reference = "Lakaemper 2009, figures 6 and 9"});

}  // namespace
}  // namespace scanbench::render
