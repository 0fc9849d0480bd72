// Figure 5 of Lakaemper 2009: one place, four times. The points of one scan, the lines found in them, the lines of all
// scans, and the merged lines.
#include <algorithm>

#include <fmt/format.h>

#include "core/registry.hpp"
#include "render/figures/parts/before_after.hpp"
#include "render/figures/parts/clusters.hpp"
#include "render/figures/parts/frames.hpp"
#include "render/figures/parts/style.hpp"
#include "render/figures/parts/view_box.hpp"

namespace scanbench::render {
namespace {

const Stroke kDetailGivenStroke{kBlue, 0.8, Dash::solid};
const Stroke kDetailMergedStroke{kBlack, 1.3, Dash::solid};

class MergeDetail : public Figure {
 public:
  struct Params {
    std::string pipeline;
    int frame = -1;
    double size_m = 0.0;
    static auto fields() {
      return std::tuple{field("pipeline", &Params::pipeline, "pipeline to show; empty: the first one that has a map"),
                        field("frame", &Params::frame, at_least(-1), "", "scan to show, from 0; -1: the middle one"),
                        field("size_m", &Params::size_m, at_least(0), "m",
                              "side of the square around most lines of the scan; 0: a third of their extent")};
    }
  };
  explicit MergeDetail(const Params& params) : params_(params) {}

  std::string why_nothing(const FigureInput&) const override {
    return "no pipeline has finished, or the recording has no scans";
  }

  std::vector<NamedScene> draw(const FigureInput& input) const override {
    const BeforeAfter both = before_after(input, params_.pipeline);
    if (both.named == nullptr || input.recording.observed.frames.empty()) return {};
    const std::size_t frame = shown_frame(input.recording, params_.frame);
    const std::vector<Segment>& found = both.given.at(frame);
    const std::vector<Vec2> points = frame_points(input.recording, frame, both.world_from_sensor[frame]);

    std::vector<Vec2> places;
    places.reserve(found.size());
    for (const Segment& s : found) places.push_back(s.midpoint());
    if (places.empty()) places = points;
    const double side = params_.size_m > 0 ? params_.size_m : std::max(extent_of(found) / 3.0, 1.0);
    const auto window = fullest_window(places, side);

    Scene scene{.width_in = kDoubleColumnIn, .columns = 2, .share_axes = true, .scale_bar = true};
    scene.title = fmt::format("{}: {}, scan {} (0 to {})", input.title, both.named->pipeline, frame,
                              input.recording.observed.frames.size() - 1);
    Points scan{.points = points, .color = kBlack, .size_pt = 1.4};
    scene.panels = {panel("a) points of one scan", window, {}, kDetailGivenStroke, points.empty() ? "no points" : ""),
                    panel("b) lines found in it", window, found, kDetailGivenStroke, found.empty() ? "no lines" : ""),
                    panel("c) lines of all scans", window, both.all_given(), kDetailGivenStroke,
                          both.given_count() == 0 ? "no lines" : ""),
                    panel("d) merged", window, both.map, kDetailMergedStroke, both.map.empty() ? "no lines" : "")};
    scene.panels[0].items.emplace_back(scan);
    scan.color = kFaintPoints;
    scene.panels[1].items.insert(scene.panels[1].items.begin(), scan);
    scene.legend = {{.text = "scan points", .marker = Marker::dot, .marker_size_pt = 2.0},
                    {.text = "lines found", .stroke = kDetailGivenStroke},
                    {.text = "lines of the map", .stroke = kDetailMergedStroke}};
    return {
        {"merge_detail",
         fmt::format("{}: a detail of {:.3g} m: points of scan {}, lines found in it, lines of all scans in the same "
                     "place, and the merged lines.",
                     input.title, side, frame),
         std::move(scene)}};
  }

 private:
  /// A panel of the lines in the window only, because the others would enlarge the file.
  static Panel panel(const std::string& title, const std::optional<Window>& window,
                     const std::vector<Segment>& segments, const Stroke& stroke, const std::string& note) {
    Panel result{.title = title};
    Lines lines{.stroke = stroke};
    if (window) {
      window->set_ranges(result);
      for (const Segment& s : segments)
        if (window->is_near(s)) lines.segments.push_back(s);
    }
    lines.segments = thinned(lines.segments, kSegmentBudget / 4);
    result.items.emplace_back(std::move(lines));
    if (!note.empty()) add_note(note, result);
    return result;
  }

  Params params_;
};

SCANBENCH_REGISTER(
    Figure, MergeDetail,
    {.name = "merge_detail",
     .summary = "a detail as points of one scan, its lines, the lines of all scans, and the merged lines",
     .reference = "Lakaemper 2009, figure 5"});

}  // namespace
}  // namespace scanbench::render
