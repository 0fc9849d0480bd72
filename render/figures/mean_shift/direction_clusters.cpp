// Figure 2c, d of Lakaemper 2009: the clusters of phase 1, segments near each other with similar directions, and the
// most crowded part of them magnified.
#include <fmt/format.h>

#include "core/registry.hpp"
#include "render/figures/mean_shift/rows.hpp"
#include "render/figures/parts/clusters.hpp"
#include "render/figures/parts/style.hpp"
#include "render/figures/parts/view_box.hpp"

namespace scanbench::render {
namespace {

class DirectionClusters : public Figure {
 public:
  struct Params {
    std::string pipeline;
    double zoom_m = 0.0;
    static auto fields() {
      return std::tuple{field("pipeline", &Params::pipeline, kPipelineDoc),
                        field("zoom_m", &Params::zoom_m, at_least(0), "m",
                              "side of the magnified square around most clusters; 0: a third of the whole extent")};
    }
  };
  explicit DirectionClusters(const Params& params) : params_(params) {}

  std::vector<std::string> trace_rows(std::string_view pipeline) const override {
    if (!shows(params_.pipeline, pipeline)) return {};
    return keys_of_mean_shift<mean_shift::JointSpaceRow, mean_shift::ClusterRow>();
  }

  std::vector<NamedScene> draw(const FigureInput& input) const override {
    const auto rows = find_mean_shift(input, params_.pipeline);
    if (!rows) return {};
    const ClusteredSegments clusters = rows->by_direction();
    Scene scene{
        .width_in = kDoubleColumnIn,
        .title = input.title + ": phase 1, " + counted(clusters.clusters(), "cluster") + " by direction and place",
        .columns = 2};
    Panel all{.title = "a) " + rows->counted_pieces()}, part{.title = "b) magnified"};
    clusters.add_segments(0.9, kSegmentBudget / 2, all);
    clusters.add_segments(1.2, kSegmentBudget / 2, part);
    const double side = params_.zoom_m > 0 ? params_.zoom_m : extent_of(clusters.segments()) / 3.0;
    if (const auto window = fullest_window(clusters.places(), side)) {
      window->set_ranges(part);
      all.items.emplace_back(window->outline());
      scene.legend.push_back({.text = "part shown in b", .stroke = window->outline().stroke});
    }
    const bool numbered = clusters.add_numbers(all);
    clusters.add_numbers(part);
    if (clusters.segments().empty()) add_note("no segments", all), add_note("no segments", part);
    scene.legend.insert(scene.legend.begin(), {.text = numbered ? "colour and number: cluster" : "colour: cluster",
                                               .stroke = Stroke{kBlue, 1.2, Dash::solid}});
    scene.panels = {std::move(all), std::move(part)};
    return {{"direction_clusters",
             fmt::format("{}: the {} of phase 1; clusters of the same colour are far apart{}.", input.title,
                         counted(clusters.clusters(), "cluster"), numbered ? ", equal numbers are one cluster" : ""),
             std::move(scene)}};
  }

 private:
  Params params_;
};

SCANBENCH_REGISTER(Figure, DirectionClusters,
                   {.name = "direction_clusters",
                    .summary = "segments by their clusters of phase 1, numbered, and the most crowded part magnified",
                    .reference = "Lakaemper 2009, figure 2 c, d"});

}  // namespace
}  // namespace scanbench::render
