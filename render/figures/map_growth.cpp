// Lines of the map against the scans inserted, a curve for each pipeline that maps scan by scan.
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/contracts/map_trace.hpp"
#include "core/registry.hpp"
#include "core/trace/trace_rows.hpp"
#include "render/figure.hpp"
#include "render/figures/parts/style.hpp"

namespace scanbench::render {
namespace {

constexpr std::string_view kGrowthSlot = "map";

/// (scan, lines of the map after it) from the trace.
std::vector<Vec2> growth_of(const NamedResult& result) {
  std::vector<Vec2> growth;
  if (result.trace == nullptr) return growth;
  if (const auto found = result.trace->find(key_of<mapping::InsertionRow>(kGrowthSlot)); found != result.trace->end())
    for (const TraceRow& raw : found->second)
      if (const auto row = row_from<mapping::InsertionRow>(raw.values)) growth.emplace_back(raw.frame, row->map_lines);
  return growth;
}

class MapGrowth : public Figure {
 public:
  using Params = NoParams;
  explicit MapGrowth(const Params&) {}

  std::vector<std::string> trace_rows(std::string_view /*pipeline*/) const override {
    return {key_of<mapping::InsertionRow>(kGrowthSlot)};
  }

  std::vector<NamedScene> draw(const FigureInput& input) const override {
    std::vector<std::pair<std::string, std::vector<Vec2>>> curves;
    std::vector<std::string> names;
    for (const NamedResult& result : input.results)
      if (std::vector<Vec2> growth = growth_of(result); !growth.empty()) {
        names.push_back(result.pipeline);
        curves.emplace_back(result.pipeline, std::move(growth));
      }
    if (curves.empty()) return {};
    const std::vector<MethodStyle> styles = method_styles(names);
    Scene scene{.width_in = kDoubleColumnIn, .title = input.title + ": growth of the map"};
    Panel panel{.x = {.label = "scan"}, .y = {.label = "lines of the map"}, .equal_aspect = false};
    for (std::size_t k = 0; k < curves.size(); ++k) {
      const Stroke stroke{styles[k].color, 1.0, styles[k].dash};
      panel.items.emplace_back(Polyline{.points = std::move(curves[k].second), .stroke = stroke});
      scene.legend.push_back({.text = curves[k].first, .stroke = stroke});
    }
    scene.panels.push_back(std::move(panel));
    scene.box_aspect = 0.4;
    return {{"map_growth", input.title + ": lines of the map after each scan; a line has two end points.",
             std::move(scene)}};
  }
};

SCANBENCH_REGISTER(Figure, MapGrowth,
                   {.name = "map_growth", .summary = "lines of the map after each scan, for mappers", .reference = ""});

}  // namespace
}  // namespace scanbench::render
