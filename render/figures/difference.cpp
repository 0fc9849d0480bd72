// The found lines of each pipeline beside the true walls in three colours: found and true, false, missed. What it shows
// are the pixels that the metric family raster_truth counts, as the parts of lines that they belong to.
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/registry.hpp"
#include "render/figures/parts/clusters.hpp"
#include "render/figures/parts/style.hpp"
#include "render/figures/parts/view_box.hpp"

namespace scanbench::render {
namespace {

// Missed parts are wide and below all others, because a found line may cross them. True ones are above the false ones,
// of which a run of many scans has many.
const Stroke kMissedStroke{kPurple, 2.4, Dash::solid}, kRightStroke{kGreen, 0.8, Dash::solid},
    kWrongStroke{kVermillion, 0.8, Dash::solid};

class Difference : public Figure {
 public:
  using Params = NoParams;
  explicit Difference(const Params&) {}

  bool compares_pixels() const override { return true; }

  std::string why_nothing(const FigureInput&) const override {
    return "no pipeline has lines that can be compared with true walls: that takes a truth, and a map or poses";
  }

  std::vector<NamedScene> draw(const FigureInput& input) const override {
    std::vector<const NamedResult*> shown;
    for (const NamedResult& named : input.results)
      if (named.difference) shown.push_back(&named);
    if (shown.empty()) return {};
    Scene scene = small_multiples(shown.size());
    scene.title = input.title + ": found lines and true walls";
    std::vector<Segment> walls = true_walls_of(input);
    for (const NamedResult* named : shown) scene.panels.push_back(panel_of(*named, walls, shown.size()));
    const PixelDifference& first = *shown.front()->difference;
    for (const auto& [text, stroke] : {std::pair("found and true", kRightStroke), std::pair("missed", kMissedStroke),
                                       std::pair("false", kWrongStroke)})
      if (draws(scene, stroke)) scene.legend.push_back({.text = text, .stroke = stroke});
    return {
        {"difference",
         fmt::format("{}: found lines and the visible parts of true walls, drawn as pixels of {:g} cm. Found pixels "
                     "within {:g} cm of a wall are true, others are false; pixels of walls farther than that from "
                     "all found lines are missed. Numbers are counts of pixels.",
                     input.title, 100 * first.pixel_m, 100 * first.tolerance_m),
         std::move(scene)}};
  }

 private:
  static std::vector<Segment> true_walls_of(const FigureInput& input) {
    std::vector<Segment> walls;
    if (input.recording.truth)
      for (const Wall& wall : input.recording.truth->walls) walls.push_back(wall.segment);
    return walls;
  }

  static Panel panel_of(const NamedResult& named, const std::vector<Segment>& walls, std::size_t panels) {
    const PixelDifference& d = *named.difference;
    Panel panel{.title = fmt::format("{}: {} true, {} missed, {} false", named.pipeline, d.right_pixels,
                                     d.missed_pixels, d.wrong_pixels),
                .tell_outside = "line"};
    const std::size_t budget = kSegmentBudget / (3 * panels);
    for (const auto& [parts, stroke] :
         {std::pair(&d.missed, kMissedStroke), std::pair(&d.wrong, kWrongStroke), std::pair(&d.right, kRightStroke)})
      if (!parts->empty()) panel.items.emplace_back(Lines{.segments = thinned(*parts, budget), .stroke = stroke});
    set_view(ends_of(d.wrong), ends_of(walls), panel);
    return panel;
  }
};

SCANBENCH_REGISTER(
    Figure, Difference,
    {.name = "difference",
     .summary = "found lines and true walls in three colours: found and true, missed, false; with counts of pixels",
     .reference = ""});

}  // namespace
}  // namespace scanbench::render
