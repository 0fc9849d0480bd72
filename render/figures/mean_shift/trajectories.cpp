// Figure 2a, b of Lakaemper 2009: the trajectories of mean shift in phase 1 from the points to their modes, seen from
// above and in the joint space.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/registry.hpp"
#include "render/figures/mean_shift/rows.hpp"
#include "render/figures/parts/style.hpp"
#include "render/figures/parts/view_box.hpp"

namespace scanbench::render {
namespace {

const Stroke kShiftPathStroke{kBlue, 0.5, Dash::solid};
const Points kStartStyle{.color = kBlack, .size_pt = 1.7};
const Points kReachedModeStyle{.marker = Marker::diamond, .color = kVermillion, .size_pt = 4.0};

/// Leaves out steps that are too small to see, and cuts the path at the seam of directions, where it leaves at one side
/// and enters at the other.
std::vector<Vec3> on_paper(const std::vector<Vec3>& path, double resolution) {
  std::vector<Vec3> result;
  const double turn = kPi * resolution;
  Vec3 last = Vec3::Zero();
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vec3& p = path[i];
    const double dz = p.z() - last.z();
    if (i > 0 && std::abs(dz) > kPi / 2) {
      const double above = dz < 0 ? kPi - last.z() : last.z(), below = dz < 0 ? p.z() : kPi - p.z();
      const double share = above + below > 0 ? above / (above + below) : 0.5;
      const Vec2 at = last.head<2>() + share * (p - last).head<2>();
      result.emplace_back(at.x(), at.y(), dz < 0 ? kPi : 0.0);
      result.emplace_back(NAN, NAN, NAN);
      result.emplace_back(at.x(), at.y(), dz < 0 ? 0.0 : kPi);
    } else if (i > 0 && i + 1 < path.size() && (p - last).head<2>().norm() < resolution && std::abs(dz) < turn) {
      continue;
    }
    result.push_back(p);
    last = p;
  }
  return result;
}

class Trajectories : public Figure {
 public:
  struct Params {
    std::string pipeline;
    static auto fields() { return std::tuple{field("pipeline", &Params::pipeline, kPipelineDoc)}; }
  };
  explicit Trajectories(const Params& params) : params_(params) {}

  std::vector<std::string> trace_rows(std::string_view pipeline) const override {
    if (!shows(params_.pipeline, pipeline)) return {};
    return keys_of_mean_shift<mean_shift::Kernel1Row, mean_shift::JointSpaceRow, mean_shift::TrajectoryRow<1>,
                              mean_shift::Mode1Row>();
  }

  std::vector<NamedScene> draw(const FigureInput& input) const override {
    const auto rows = find_mean_shift(input, params_.pipeline);
    if (!rows) return {};
    Scene scene{.width_in = kDoubleColumnIn, .title = input.title + ": mean shift, phase 1", .columns = 2};
    const View3 view = joint_space_view(*rows);
    Panel above{.title = "a) from above"};
    Panel joint = view.panel(36.0 * scene.width_in, scene.font_pt);
    joint.title = "b) in the joint space";

    const double resolution = 0.002 * std::max(extent_of(rows->segments()), 1e-6);
    const std::size_t stride = rows->paths.size() / (kPointBudget / 8) + 1;
    Polyline flat{.points = {}, .stroke = kShiftPathStroke}, deep = flat;
    std::vector<Vec3> starts;
    for (std::size_t k = 0; k < rows->paths.size(); k += stride) {
      starts.push_back(rows->pieces[k].point);
      for (const Vec3& p : on_paper(rows->paths[k], resolution)) {
        flat.points.emplace_back(p.head<2>());
        deep.points.push_back(view.project(on_axes(p)));
      }
      flat.points.emplace_back(NAN, NAN);
      deep.points.emplace_back(NAN, NAN);
    }
    above.items.emplace_back(std::move(flat));
    joint.items.emplace_back(std::move(deep));
    add_dots(view, starts, kStartStyle, above, joint);
    const std::vector<Vec3> modes = distinct(rows->ends);
    add_dots(view, modes, kReachedModeStyle, above, joint);
    if (rows->pieces.empty()) add_note("no segments", above), add_note("no segments", joint);
    scene.panels = {std::move(above), std::move(joint)};
    scene.legend = {{.text = "points", .marker = Marker::dot, .marker_size_pt = 2.4},
                    {.text = "their trajectories", .stroke = Stroke{kBlue, 0.8, Dash::solid}},
                    {.text = "modes of the density",
                     .marker = kReachedModeStyle.marker,
                     .marker_color = kReachedModeStyle.color,
                     .marker_size_pt = kReachedModeStyle.size_pt}};
    return {{"trajectories",
             fmt::format(
                 "{}: trajectories of {} to {} of the density in phase 1 (sigma {:.3g} m, 10 deg count as {:.3g} m). "
                 "A trajectory that leaves at 180 deg continues at 0.",
                 input.title, rows->counted_pieces(), counted(modes.size(), "mode"), rows->sigma_m,
                 rows->h_rad_per_m > 0 ? radians(10.0) / rows->h_rad_per_m : 0.0),
             std::move(scene)}};
  }

 private:
  static void add_dots(const View3& view, const std::vector<Vec3>& points, const Points& style, Panel& above,
                       Panel& joint) {
    Points flat = style, deep = style;
    for (const Vec3& p : points) {
      flat.points.emplace_back(p.head<2>());
      deep.points.push_back(view.project(on_axes(p)));
    }
    above.items.emplace_back(std::move(flat));
    joint.items.emplace_back(std::move(deep));
  }

  /// Pieces that end in one mode end at the same coordinates.
  static std::vector<Vec3> distinct(std::vector<Vec3> ends) {
    const auto key = [](const Vec3& p) { return std::array{p.x(), p.y(), p.z()}; };
    std::ranges::sort(ends, {}, key);
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    return ends;
  }

  Params params_;
};

SCANBENCH_REGISTER(Figure, Trajectories,
                   {.name = "trajectories",
                    .summary = "paths of mean shift from the points of the joint space to the modes, in 2-D and 3-D",
                    .reference = "Lakaemper 2009, figure 2 a, b"});

}  // namespace
}  // namespace scanbench::render
