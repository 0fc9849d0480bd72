// Mean shift that climbs: the points of phase 1 of Lakaemper 2009 on their paths to the modes of the density, from
// above and by direction.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/geometry/angles.hpp"
#include "core/registry.hpp"
#include "render/figures/mean_shift/rows.hpp"
#include "render/figures/parts/style.hpp"
#include "render/figures/parts/view_box.hpp"
#include "render/film.hpp"
#include "render/films/stage.hpp"

namespace scanbench::render {
namespace {

constexpr std::size_t kMostPaths = 1500;
constexpr std::size_t kStepsPerIteration = 12;  // mean shift needs few iterations; between them points move evenly
constexpr double kSettledM = 0.002;             // a step that cannot be seen
const Stroke kTrail{kSky, 0.6, Dash::solid};

/// Paths of equal length: a point that has arrived stays at its mode.
std::vector<std::vector<Vec3>> paths_of(const MeanShiftRows& rows) {
  std::vector<std::vector<Vec3>> paths;
  const std::size_t stride = rows.paths.size() / kMostPaths + 1;
  for (std::size_t i = 0; i < rows.paths.size(); i += stride)
    if (!rows.paths[i].empty()) paths.push_back(rows.paths[i]);
  return paths;
}

/// Iterations until all points have nearly arrived.
std::size_t length_of(const std::vector<std::vector<Vec3>>& paths) {
  std::size_t length = 0;
  for (const auto& path : paths) {
    std::size_t n = path.size();
    while (n > 1 && (path[n - 2].head<2>() - path.back().head<2>()).norm() < kSettledM) --n;
    length = std::max(length, n);
  }
  return length;
}

/// The point after a number of steps; it stays at the end of its path. A direction that leaves at 180 deg and continues
/// at 0 jumps.
Vec3 point_at(const std::vector<Vec3>& path, std::size_t step) {
  const std::size_t passed = step / kStepsPerIteration;
  if (passed + 1 >= path.size()) return path.back();
  const Vec3 &from = path[passed], &to = path[passed + 1];
  if (std::abs(to.z() - from.z()) > kPi / 2) return from;
  return from + (to - from) * (static_cast<double>(step % kStepsPerIteration) / kStepsPerIteration);
}

class MeanShiftClimbs final : public FilmKind {
 public:
  using Params = NoParams;
  explicit MeanShiftClimbs(const Params&) {}

  std::vector<std::string> trace_rows() const override {
    return keys_of_mean_shift<mean_shift::Kernel1Row, mean_shift::JointSpaceRow, mean_shift::TrajectoryRow<1>,
                              mean_shift::Mode1Row>();
  }

  std::optional<Film> make(const FigureInput& input, std::size_t most) const override {
    const auto rows = find_mean_shift(input, "");
    if (!rows) return std::nullopt;
    const auto paths = std::make_shared<const std::vector<std::vector<Vec3>>>(paths_of(*rows));
    if (paths->empty()) return std::nullopt;
    const auto steps = chosen_steps((length_of(*paths) - 1) * kStepsPerIteration + 1, most);
    const auto scene = [&input, paths, steps, views = views_of(*paths)](std::size_t k) {
      std::vector<Panel> panels{views.first, views.second};
      Polyline trail_above{.points = {}, .stroke = kTrail};
      Points above{.points = {}, .color = kBlack, .size_pt = 2.2}, beside = above;
      for (const auto& path : *paths) {
        const std::size_t passed = std::min(steps[k] / kStepsPerIteration, path.size() - 1);
        const Vec3 now = point_at(path, steps[k]);
        for (std::size_t t = 0; t <= passed; ++t) trail_above.points.emplace_back(path[t].head<2>());
        trail_above.points.emplace_back(now.head<2>());
        trail_above.points.emplace_back(NAN, NAN);  // ends this trail
        above.points.emplace_back(now.head<2>());
        beside.points.emplace_back(now.x(), degrees(now.z()));
      }
      panels[0].items = {std::move(trail_above), std::move(above)};
      panels[1].items = {std::move(beside)};
      return film_scene(fmt::format("{}, {}: mean shift, phase 1, iteration {}", input.title,
                                    input.results.front().pipeline, steps[k] / kStepsPerIteration),
                        std::move(panels),
                        {{.text = "centres of segments", .marker = Marker::dot, .marker_size_pt = 2.4},
                         {.text = "their paths to the modes", .stroke = kTrail}});
    };
    return Film{steps.size(), scene,
                fmt::format("{}: {} climb to the modes of their density.", input.title, rows->counted_pieces())};
  }

 private:
  static std::pair<Panel, Panel> views_of(const std::vector<std::vector<Vec3>>& paths) {
    Panel above{.title = "a) from above"};
    std::vector<Vec2> places;
    places.reserve(paths.size());
    for (const auto& path : paths) places.emplace_back(path.front().head<2>());
    set_view(places, places, above);
    Panel beside{.title = "b) direction", .y = {.label = "direction [°]", .range = std::pair(-5.0, 185.0)}};
    beside.x.range = above.x.range;
    beside.equal_aspect = false;
    return {std::move(above), std::move(beside)};
  }
};

SCANBENCH_REGISTER(FilmKind, MeanShiftClimbs,
                   {.name = "mean_shift",
                    .summary = "points that climb to their modes",
                    .reference = "Lakaemper 2009, figure 2"});

}  // namespace
}  // namespace scanbench::render
