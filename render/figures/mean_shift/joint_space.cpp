// Figure 1 of Lakaemper 2009: the centre-direction joint space, a point for each (piece of a) segment, over the
// segments.
#include <fmt/format.h>

#include "core/registry.hpp"
#include "render/figures/mean_shift/rows.hpp"
#include "render/figures/parts/style.hpp"

namespace scanbench::render {
namespace {

class JointSpace : public Figure {
 public:
  struct Params {
    std::string pipeline;
    double width_in = 4.6;
    static auto fields() {
      return std::tuple{field("pipeline", &Params::pipeline, kPipelineDoc),
                        field("width_in", &Params::width_in, between(2, 20), "in", "width on paper")};
    }
  };
  explicit JointSpace(const Params& params) : params_(params) {}

  std::vector<std::string> trace_rows(std::string_view pipeline) const override {
    if (!shows(params_.pipeline, pipeline)) return {};
    return keys_of_mean_shift<mean_shift::JointSpaceRow>();
  }

  std::vector<NamedScene> draw(const FigureInput& input) const override {
    const auto rows = find_mean_shift(input, params_.pipeline);
    if (!rows) return {};
    Scene scene{.width_in = params_.width_in, .title = input.title + ": centre-direction joint space"};
    const View3 view = joint_space_view(*rows);
    Panel panel = view.panel(72.0 * scene.width_in, scene.font_pt);
    Lines floor{.stroke = {kGrey, 0.7, Dash::solid}};
    std::vector<Vec3> points;
    const std::size_t stride = rows->pieces.size() / kPointBudget + 1;
    for (std::size_t k = 0; k < rows->pieces.size(); k += stride) {
      const auto& [a, b] = rows->pieces[k].segment;
      floor.segments.push_back({view.project({a.x(), a.y(), 0.0}), view.project({b.x(), b.y(), 0.0})});
      points.push_back(on_axes(rows->pieces[k].point));
    }
    if (rows->pieces.empty()) add_note("no segments", panel);
    scene.legend = {
        {.text = "segments (on the floor)", .stroke = floor.stroke},
        {.text = "their centres and directions", .marker = Marker::dot, .marker_color = kBlue, .marker_size_pt = 3.0}};
    panel.items.emplace_back(std::move(floor));
    add_points_by_depth(view, points, {.color = kBlue, .size_pt = 2.4}, panel);
    scene.panels.push_back(std::move(panel));
    return {{"joint_space",
             fmt::format("{}: centre-direction joint space of {}: x and y of the centre, direction modulo 180 deg (top "
                         "and floor are neighbours), over the segments themselves; the farther a point, the paler.",
                         input.title, rows->counted_pieces()),
             std::move(scene)}};
  }

 private:
  Params params_;
};

SCANBENCH_REGISTER(Figure, JointSpace,
                   {.name = "joint_space",
                    .summary = "segments as points of the centre-direction joint space, in 3-D",
                    .reference = "Lakaemper 2009, figure 1"});

}  // namespace
}  // namespace scanbench::render
