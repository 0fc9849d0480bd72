// Figures 10 and 12 of Lakaemper 2010: the lines of all scans where an aligner had them at some iterations, with the
// hypotheses that it made of them.
#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/registry.hpp"
#include "core/trace/trace_rows.hpp"
#include "render/figure.hpp"
#include "render/figures/parts/clusters.hpp"
#include "render/figures/parts/frames.hpp"
#include "render/figures/parts/iterations.hpp"
#include "render/figures/parts/style.hpp"
#include "render/figures/parts/view_box.hpp"

namespace scanbench::render {
namespace {

// Wide and pale under the lines that they explain: colours of scans may be dark.
const Stroke kHypothesisStroke{Color{200, 200, 200}, 2.6, Dash::solid};
constexpr double kScanWidthPt = 0.6;

class VirtualScans : public Figure {
 public:
  struct Params {
    std::string pipeline;
    std::vector<double> iterations{0, 10, 20, 30};
    bool last = true;
    static auto fields() {
      return std::tuple{field("pipeline", &Params::pipeline, "pipeline to show; empty: the first one with such rows"),
                        field("iterations", &Params::iterations, between(0, 1e6), "",
                              "iterations that are shown, if they took place"),
                        field("last", &Params::last, "also show the poses after the last one, without hypotheses")};
    }
  };
  explicit VirtualScans(Params params) : params_(std::move(params)) {}

  std::vector<std::string> trace_rows(std::string_view pipeline) const override {
    if (!shows(params_.pipeline, pipeline)) return {};
    return keys_of_iterations();
  }

  std::string why_nothing(const FigureInput&) const override { return "no pipeline has lines of every scan"; }

  std::vector<NamedScene> draw(const FigureInput& input) const override {
    const std::size_t scans = input.recording.observed.frames.size();
    const NamedResult* shown = nullptr;
    AlignerIterations iterations;
    for (const NamedResult& r : input.results) {
      if (!shows(params_.pipeline, r.pipeline) || r.result->lines.size() != scans) continue;
      AlignerIterations found = aligner_iterations(r.trace, scans);
      if (shown != nullptr && found.hypotheses.empty()) continue;
      shown = &r;
      iterations = std::move(found);
      if (!iterations.hypotheses.empty()) break;
    }
    if (shown == nullptr || scans == 0) return {};

    Scene scene;
    for (const double wanted : params_.iterations) {
      const int t = static_cast<int>(wanted);
      if (const auto poses = iterations.poses.find(t); poses != iterations.poses.end())
        add_panel(*shown, fmt::format("iteration {}", t), poses->second, iterations.hypotheses_at(t), scene);
    }
    if (params_.last || scene.panels.empty())
      add_panel(*shown, "result", place_frames(input.recording, shown->result).world_from_sensor, nullptr, scene);
    arrange_multiples(scene);
    scene.title = input.title + ": virtual scans";
    scene.legend = {{.text = "lines, a colour for each scan", .stroke = Stroke{kScanColor, kScanWidthPt, Dash::solid}}};
    if (draws(scene, kHypothesisStroke)) scene.legend.push_back({.text = "hypotheses", .stroke = kHypothesisStroke});
    return {{"virtual_scans",
             fmt::format("{}: lines of {} as {} had placed them, and its hypotheses about lines and rectangles.",
                         input.title, counted(scans, "scan"), shown->pipeline),
             std::move(scene)}};
  }

 private:
  static void add_panel(const NamedResult& shown, const std::string& title, const std::vector<Pose2>& poses,
                        const std::vector<std::vector<Vec2>>* hypotheses, Scene& scene) {
    Panel panel{.title = fmt::format("{}) {}", static_cast<char>('a' + scene.panels.size()), title)};
    std::vector<Vec2> places;
    for (const Pose2& pose : poses) places.push_back(pose.translation());
    const std::vector<Color> colors = cluster_colors(places);
    std::size_t lines = 0;
    for (const auto& of_scan : shown.result->lines) lines += of_scan.lines.size();
    const std::size_t stride = lines / (kSegmentBudget / 5) + 1;
    std::size_t count = 0;
    if (hypotheses != nullptr) {
      for (const std::vector<Vec2>& corners : *hypotheses)
        panel.items.emplace_back(Polyline{.points = corners, .stroke = kHypothesisStroke, .closed = true});
    }
    for (std::size_t f = 0; f < poses.size(); ++f) {
      Lines of_scan{.stroke = {colors[f], kScanWidthPt, Dash::solid}};
      for (const LineFeature& line : shown.result->lines[f].lines)
        if (count++ % stride == 0) of_scan.segments.push_back(poses[f] * line.segment);
      panel.items.emplace_back(std::move(of_scan));
    }
    if (lines == 0) add_note("no lines", panel);
    scene.panels.push_back(std::move(panel));
  }

  Params params_;
};

SCANBENCH_REGISTER(
    Figure, VirtualScans,
    {.name = "virtual_scans",
     .summary = "lines of all scans at some iterations of an alignment, with its hypotheses about lines and rectangles",
     .reference = "Lakaemper 2010, figures 10 and 12"});

}  // namespace
}  // namespace scanbench::render
