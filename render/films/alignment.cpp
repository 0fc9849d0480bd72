// An alignment: the lines of all scans after each iteration of an aligner, with its hypotheses about lines and
// rectangles.
#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/registry.hpp"
#include "core/trace/trace_rows.hpp"
#include "render/figures/parts/clusters.hpp"
#include "render/figures/parts/iterations.hpp"
#include "render/figures/parts/style.hpp"
#include "render/figures/parts/view_box.hpp"
#include "render/film.hpp"
#include "render/films/stage.hpp"

namespace scanbench::render {
namespace {

const Stroke kHypothesis{Color{200, 200, 200}, 2.6, Dash::solid};

struct Iteration {
  int number = 0;
  std::vector<Pose2> poses;                     ///< of all scans
  std::vector<std::vector<Vec2>> hypotheses{};  ///< corners
};

std::vector<Iteration> film_iterations_of(const TraceRows* trace, std::size_t scans) {
  AlignerIterations rows = aligner_iterations(trace, scans);
  std::vector<Iteration> iterations;
  iterations.reserve(rows.poses.size());
  for (auto& [number, poses] : rows.poses) {
    const auto* suspected = rows.hypotheses_at(number);
    iterations.push_back({number, std::move(poses), suspected != nullptr ? *suspected : Iteration{}.hypotheses});
  }
  return iterations;
}

std::string hypotheses(std::size_t count) {
  return fmt::format("{} {}", count, count == 1 ? "hypothesis" : "hypotheses");
}

class AlignmentMoves final : public FilmKind {
 public:
  using Params = NoParams;
  explicit AlignmentMoves(const Params&) {}

  std::vector<std::string> trace_rows() const override { return keys_of_iterations(); }

  std::optional<Film> make(const FigureInput& input, std::size_t most) const override {
    if (input.results.empty()) return std::nullopt;
    const NamedResult& shown = input.results.front();
    const auto iterations =
        std::make_shared<const std::vector<Iteration>>(film_iterations_of(shown.trace, shown.result->lines.size()));
    if (iterations->empty()) return std::nullopt;
    const auto steps = chosen_steps(iterations->size(), most);
    std::vector<Vec2> places;
    for (const Pose2& pose : iterations->back().poses) places.push_back(pose.translation());
    const bool has_hypotheses =
        std::ranges::any_of(*iterations, [](const Iteration& iteration) { return !iteration.hypotheses.empty(); });
    const auto scene = [&input, &shown, iterations, steps, has_hypotheses, colors = cluster_colors(places),
                        view = view_of(shown, *iterations)](std::size_t k) {
      const Iteration& now = (*iterations)[steps[k]];
      Panel panel = view;
      panel.title = fmt::format("{}: iteration {}, {}", shown.pipeline, now.number, hypotheses(now.hypotheses.size()));
      for (const auto& corners : now.hypotheses)
        panel.items.emplace_back(Polyline{.points = corners, .stroke = kHypothesis, .closed = true});
      for (std::size_t f = 0; f < now.poses.size(); ++f) {
        Lines lines{.segments = {}, .stroke = {colors[f], 0.8, Dash::solid}};
        for (const LineFeature& line : shown.result->lines[f].lines)
          lines.segments.push_back(now.poses[f] * line.segment);
        panel.items.emplace_back(std::move(lines));
      }
      std::vector<LegendEntry> legend{
          {.text = "lines, a colour for each scan", .stroke = Stroke{kScanColor, 0.8, Dash::solid}}};
      if (has_hypotheses) legend.push_back({.text = "hypotheses", .stroke = kHypothesis});
      return film_scene(input.title, {std::move(panel)}, std::move(legend));
    };
    return Film{steps.size(), scene,
                fmt::format("{}: the lines of {} after each iteration of {}.", input.title,
                            counted(shown.result->lines.size(), "scan"), shown.pipeline)};
  }

 private:
  /// The range of the first and the last iteration.
  static Panel view_of(const NamedResult& shown, const std::vector<Iteration>& iterations) {
    std::vector<Vec2> ends;
    for (const Iteration* iteration : {&iterations.front(), &iterations.back()})
      for (std::size_t f = 0; f < iteration->poses.size(); ++f)
        for (const LineFeature& line : shown.result->lines[f].lines) {
          const Segment placed = iteration->poses[f] * line.segment;
          ends.insert(ends.end(), {placed.a, placed.b});
        }
    Panel panel;
    set_view(ends, {}, panel);
    return panel;
  }
};

SCANBENCH_REGISTER(FilmKind, AlignmentMoves,
                   {.name = "alignment",
                    .summary = "scans that an aligner moves, with its hypotheses",
                    .reference = "Lakaemper 2010, figures 10 and 12"});

}  // namespace
}  // namespace scanbench::render
