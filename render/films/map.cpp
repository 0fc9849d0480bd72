// A map that grows: that of a mapper after each scan, from its trace; else the lines of all scans so far, and at the
// end the map that a merger made of them.
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/contracts/map_trace.hpp"
#include "core/registry.hpp"
#include "core/trace/trace_rows.hpp"
#include "render/figures/parts/frames.hpp"
#include "render/figures/parts/style.hpp"
#include "render/figures/parts/view_box.hpp"
#include "render/film.hpp"
#include "render/films/stage.hpp"

namespace scanbench::render {
namespace {

constexpr std::string_view kMapFilmSlot = "map";
const Stroke kMapFilmPath{kPathColor, 0.8, Dash::solid};
const Stroke kNewest{kVermillion, 1.6, Dash::solid};
const Stroke kMerged{kBlack, 1.4, Dash::solid};

/// The lines of a mapper's map as they come and go: number of the frame, number of the line.
struct Changes {
  std::multimap<int, std::pair<int, Segment>> born;
  std::multimap<int, int> gone;

  explicit Changes(const TraceRows* trace) {
    if (trace == nullptr) return;
    if (const auto rows = trace->find(key_of<mapping::BornRow>(kMapFilmSlot)); rows != trace->end())
      for (const TraceRow& raw : rows->second)
        if (const auto row = row_from<mapping::BornRow>(raw.values))
          born.emplace(raw.frame, std::pair(row->line, Segment{{row->x1_m, row->y1_m}, {row->x2_m, row->y2_m}}));
    if (const auto rows = trace->find(key_of<mapping::GoneRow>(kMapFilmSlot)); rows != trace->end())
      for (const TraceRow& raw : rows->second)
        if (const auto row = row_from<mapping::GoneRow>(raw.values)) gone.emplace(raw.frame, row->line);
  }

  std::vector<Segment> map_after(int frame) const {
    std::map<int, Segment> lines;
    for (auto it = born.begin(); it != born.upper_bound(frame); ++it) lines[it->second.first] = it->second.second;
    for (auto it = gone.begin(); it != gone.upper_bound(frame); ++it) lines.erase(it->second);
    std::vector<Segment> segments;
    segments.reserve(lines.size());
    for (const auto& [number, segment] : lines) segments.push_back(segment);
    return segments;
  }
};

/// What every frame needs.
struct Growth {
  Changes changes;
  std::vector<Pose2> poses;
  std::vector<std::vector<Segment>> found;  ///< by scan, world
  std::vector<Segment> map;                 ///< at the end; empty without one
  Panel view;

  std::vector<Segment> lines_after(std::size_t f, bool last) const {
    if (!changes.born.empty()) return changes.map_after(static_cast<int>(f));
    if (last && !map.empty()) return map;
    std::vector<Segment> lines;
    for (std::size_t k = 0; k <= f; ++k) lines.insert(lines.end(), found[k].begin(), found[k].end());
    return lines;
  }
};

class MapGrows final : public FilmKind {
 public:
  using Params = NoParams;
  explicit MapGrows(const Params&) {}

  std::vector<std::string> trace_rows() const override {
    return {key_of<mapping::BornRow>(kMapFilmSlot), key_of<mapping::GoneRow>(kMapFilmSlot)};
  }

  std::optional<Film> make(const FigureInput& input, std::size_t most) const override {
    if (input.results.empty()) return std::nullopt;
    const NamedResult& shown = input.results.front();
    const std::size_t frames = shown.result->lines.size();
    const auto growth = std::make_shared<const Growth>(growth_of(input.recording, shown));
    if (frames == 0 || growth->poses.size() != frames) return std::nullopt;
    const auto steps = chosen_steps(frames, most);
    const auto scene = [&input, &shown, steps, growth, frames](std::size_t k) {
      const std::size_t f = steps[k];
      const bool last = k + 1 == steps.size(), is_merged = last && growth->changes.born.empty() && !growth->map.empty();
      Panel panel = growth->view;
      Lines lines{growth->lines_after(f, last),
                  is_merged ? kMerged : Stroke{method_color(input.results, 0), 0.9, Dash::solid}};
      panel.title = fmt::format("{}: scan {} (0 to {}), {}", shown.pipeline, f, frames - 1,
                                counted(lines.segments.size(), "line") + (is_merged ? " of the map" : ""));
      panel.items.emplace_back(std::move(lines));
      if (!is_merged) panel.items.emplace_back(Lines{growth->found[f], kNewest});
      add_path(input, std::span(growth->poses).first(f + 1), kMapFilmPath, panel);
      panel.items.emplace_back(Arrow{.pose = growth->poses[f], .length_pt = 14, .stroke = kNewest});
      const bool is_map = is_merged || !growth->changes.born.empty();
      std::vector<LegendEntry> legend{
          {.text = is_map ? "map" : "lines of all scans so far",
           .stroke = is_merged ? kMerged : Stroke{method_color(input.results, 0), 0.9, Dash::solid}}};
      if (!is_merged) legend.push_back({.text = "lines of this scan", .stroke = kNewest});
      legend.push_back(path_legend(input, kMapFilmPath));
      return film_scene(input.title, {std::move(panel)}, std::move(legend));
    };
    return Film{steps.size(), scene, caption_of(input.title, shown.pipeline, *growth)};
  }

 private:
  static std::string caption_of(const std::string& title, const std::string& pipeline, const Growth& growth) {
    if (!growth.changes.born.empty()) return fmt::format("{}: the map of {} after each scan.", title, pipeline);
    const std::string lines = fmt::format("{}: the lines of {} in all scans so far", title, pipeline);
    return growth.map.empty() ? lines + "; it makes no map." : lines + ", and at the end its map.";
  }

  static Growth growth_of(const Recording& recording, const NamedResult& shown) {
    Growth growth{.changes = Changes(shown.trace),
                  .poses = place_frames(recording, shown.result).world_from_sensor,
                  .found = {},
                  .map = {},
                  .view = {}};
    std::vector<Vec2> ends;
    for (std::size_t f = 0; f < shown.result->lines.size() && f < growth.poses.size(); ++f) {
      auto& lines = growth.found.emplace_back();
      for (const LineFeature& line : shown.result->lines[f].lines) lines.push_back(growth.poses[f] * line.segment);
      for (const Vec2& end : ends_of(lines)) ends.push_back(end);
    }
    for (const MapLine& line : shown.result->map.lines) growth.map.push_back(line.segment);
    std::vector<Vec2> places;
    for (const Pose2& pose : growth.poses) places.push_back(pose.translation());
    set_view(ends, places, growth.view);
    return growth;
  }
};

SCANBENCH_REGISTER(FilmKind, MapGrows, {.name = "map", .summary = "a map that grows scan by scan", .reference = ""});

}  // namespace
}  // namespace scanbench::render
