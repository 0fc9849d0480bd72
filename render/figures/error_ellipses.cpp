// Estimated against empirical covariance: the errors of matched poses, or of lines, as dots, the ellipse of their own
// second moments, and the ellipse of the mean covariance that the modules report. Both contain 95 % of a normal
// distribution. An honest module has equal ellipses; one that is too sure of itself has the smaller estimated one.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/geometry/pose_errors.hpp"
#include "core/geometry/symmetric_matrix.hpp"
#include "core/index.hpp"
#include "core/registry.hpp"
#include "render/figures/parts/style.hpp"

namespace scanbench::render {
namespace {

const Stroke kEmpirical{kBlue, 1.2, Dash::solid}, kEstimated{kVermillion, 1.2, Dash::dashed};
constexpr double kChiSquare95 = 5.991464547107979;  // two degrees of freedom: -2 ln 0.05
// A line farther off is on another wall: the largest errors of a match in the metric family segments.
constexpr double kLargestOffset = 0.15, kLargestAngle = radians(10);
constexpr std::size_t kLeastErrors = 8;  // fewer have no ellipse worth drawing
constexpr std::size_t kMostDots = 3000;  // per panel
constexpr double kSameScale = 2.0;       // of ranges: an ellipse on the scale of a much larger one is a dot

/// Errors in two coordinates and their covariances, in the units of the axes.
struct Errors {
  std::vector<Vec2> errors;
  std::vector<Eigen::Matrix2d> covariances;
};

Eigen::Matrix2d mean_of(const std::vector<Eigen::Matrix2d>& all) {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (const Eigen::Matrix2d& c : all) sum += c;
  return sum / static_cast<double>(all.size());
}

/// Second moments about zero: a bias is part of the error.
Eigen::Matrix2d moments_of(const std::vector<Vec2>& errors) {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (const Vec2& e : errors) sum += e * e.transpose();
  return sum / static_cast<double>(errors.size());
}

Ellipse ellipse_of(const Eigen::Matrix2d& covariance, const Stroke& stroke) {
  const SymmetricEigen<Eigen::Matrix2d> eigen = symmetric_eigen(covariance);
  const Vec2 axis = eigen.vectors.col(1);
  const auto semi = [&](Eigen::Index k) { return std::sqrt(kChiSquare95 * std::max(eigen.values[k], 0.0)); };
  return {.semi_axes = {semi(1), semi(0)}, .angle_rad = std::atan2(axis.y(), axis.x()), .stroke = stroke};
}

/// (offset along the normal of the found line at a point near both lines [m], angle [rad]), as metrics/efficiency.cpp
/// has it: near the sensor the normals can have opposite directions.
Vec2 line_error(const PolarLine& found, const PolarLine& truth, const Vec2& point) {
  const double side = found.normal().dot(truth.normal()) < 0 ? -1.0 : 1.0;
  return {found.signed_distance(point) - side * truth.signed_distance(point),
          std::atan2(side * cross(truth.normal(), found.normal()), side * truth.normal().dot(found.normal()))};
}

enum class Of { lines, matches };

class ErrorEllipses : public Figure {
 public:
  struct Params {
    Of of = Of::lines;
    static auto fields() {
      return std::tuple{choice("of", &Params::of, {{Of::lines, "lines"}, {Of::matches, "matches"}},
                               "errors of lines as (offset, angle), or of matched poses as (x, y)")};
    }
  };
  explicit ErrorEllipses(const Params& params) : params_(params) {}

  std::string why_nothing(const FigureInput& input) const override {
    if (!input.recording.truth) return "there is no truth";
    return fmt::format("no pipeline has {} {} with a covariance", kLeastErrors,
                       params_.of == Of::lines ? "lines on walls" : "converged matches");
  }

  std::vector<NamedScene> draw(const FigureInput& input) const override {
    if (!input.recording.truth) return {};
    const bool lines = params_.of == Of::lines;
    Scene scene;
    for (const NamedResult& named : input.results) {
      const Errors found =
          lines ? line_errors(input.recording, *named.result) : match_errors(*input.recording.truth, *named.result);
      if (found.errors.size() >= kLeastErrors) scene.panels.push_back(panel_of(named.pipeline, found));
    }
    if (scene.panels.empty()) return {};
    arrange_multiples(scene);
    scene.title = input.title + ": estimated and empirical covariance";
    scene.scale_bar = false;
    scene.share_axes = of_one_scale(scene.panels);
    scene.legend = {{.text = "errors", .marker = Marker::dot, .marker_color = kFaintPoints, .marker_size_pt = 2.4},
                    {.text = "95 % of the errors, empirical", .stroke = kEmpirical},
                    {.text = "95 % as estimated", .stroke = kEstimated}};
    return {{"error_ellipses",
             fmt::format("{}: errors of {}, with the ellipses that contain 95 % of a normal distribution with their "
                         "second moments (empirical) and with the mean of the reported covariances (estimated).{}",
                         input.title,
                         lines ? "lines at their midpoints" : "converged matches, in the reference scan's frame",
                         scene.share_axes ? "" : " Every panel has its own scale."),
             std::move(scene)}};
  }

 private:
  /// True if the ellipses of all panels can be seen on the axes of the largest.
  static bool of_one_scale(const std::vector<Panel>& panels) {
    for (const auto axis : {&Panel::x, &Panel::y}) {
      const auto reach = [&](const Panel& panel) { return (panel.*axis).range->second; };
      const auto [least, most] = std::ranges::minmax(panels, {}, reach);
      if (reach(most) > kSameScale * reach(least)) return false;
    }
    return true;
  }

  Panel panel_of(const std::string& name, const Errors& found) const {
    const bool lines = params_.of == Of::lines;
    const Ellipse empirical = ellipse_of(moments_of(found.errors), kEmpirical);
    const Ellipse estimated = ellipse_of(mean_of(found.covariances), kEstimated);
    Panel panel{.title = fmt::format("{}: {} {}", name, found.errors.size(), lines ? "lines" : "matches"),
                .x = {.label = lines ? "offset error [mm]" : "x error [mm]"},
                .y = {.label = lines ? "angle error [°]" : "y error [mm]"},
                .equal_aspect = !lines,
                .tell_outside = "point",
                .items = {}};
    Points dots{.color = kFaintPoints, .size_pt = 1.6};
    const std::size_t stride = (found.errors.size() + kMostDots - 1) / kMostDots;
    for (std::size_t k = 0; k < found.errors.size(); k += stride) dots.points.push_back(found.errors[k]);
    // The view is 1.6 times the larger ellipse, not the farthest error.
    const auto reach = [&](Eigen::Index axis) {
      const double a = std::sqrt(moments_of(found.errors)(axis, axis)),
                   b = std::sqrt(mean_of(found.covariances)(axis, axis));
      return 1.6 * std::sqrt(kChiSquare95) * std::max({a, b, 1e-9});
    };
    panel.x.range = {-reach(0), reach(0)};
    panel.y.range = {-reach(1), reach(1)};
    panel.items.emplace_back(std::move(dots));
    panel.items.emplace_back(empirical);
    panel.items.emplace_back(estimated);
    return panel;
  }

  /// Errors of (x, y) in millimetres, in the frame of the reference scan.
  static Errors match_errors(const Truth& truth, const PipelineResult& result) {
    Errors found;
    const auto known = [&](int frame) { return frame >= 0 && as_index(frame) < truth.world_from_sensor.size(); };
    for (const FrameMatch& m : result.matches) {
      const Eigen::Matrix2d covariance = 1e6 * m.match.covariance.topLeftCorner<2, 2>();
      if (!known(m.frame) || !known(m.reference) || m.match.status != Status::converged || !(covariance.trace() > 0))
        continue;
      const Pose2 true_motion =
          truth.world_from_sensor[as_index(m.reference)].inverse() * truth.world_from_sensor[as_index(m.frame)];
      found.errors.emplace_back(1e3 * pose_error(m.match.reference_from_current, true_motion).head<2>());
      found.covariances.push_back(covariance);
    }
    return found;
  }

  /// Errors of (offset [mm], angle [deg]) at the midpoint, from the wall that most of the line's beams hit.
  static Errors line_errors(const Recording& recording, const PipelineResult& result) {
    Errors found;
    const Truth& truth = *recording.truth;
    for (std::size_t f = 0; f < result.lines.size() && f < truth.world_from_sensor.size(); ++f)
      for (std::size_t k = 0; k < result.lines[f].lines.size(); ++k) {
        const LineFeature& line = result.lines[f].lines[k];
        if (!line.covariance) continue;
        const std::optional<std::size_t> wall = wall_of(truth, result.lines[f], f, static_cast<int>(k));
        if (!wall) continue;
        const Segment s = truth.world_from_sensor[f].inverse() * truth.walls[*wall].segment;
        const Vec2 e = line_error(line.line, line_through(s.a, s.b), line.segment.midpoint());
        const Eigen::DiagonalMatrix<double, 2> units(1e3, degrees(1.0));
        if (std::abs(e[0]) > kLargestOffset || std::abs(e[1]) > kLargestAngle) continue;
        found.errors.emplace_back(units * e);
        found.covariances.emplace_back(units * *line.covariance * units);
      }
    return found;
  }

  /// The wall that most of the beams of a line hit; none if its beams hit no wall, or walls are not known.
  static std::optional<std::size_t> wall_of(const Truth& truth, const ScanLines& lines, std::size_t frame, int line) {
    std::map<std::int32_t, int> hits;
    const std::size_t beams = lines.labels.size();
    if (truth.wall_ids.size() < (frame + 1) * beams) return std::nullopt;
    for (std::size_t i = 0; i < beams; ++i)
      if (lines.labels[i] == line) ++hits[truth.wall_ids[frame * beams + i]];
    if (hits.empty()) return std::nullopt;
    const auto most = std::ranges::max_element(hits, {}, [](const auto& hit) { return hit.second; });
    if (most->first < 0) return std::nullopt;
    return as_index(most->first);
  }

  Params params_;
};

SCANBENCH_REGISTER(Figure, ErrorEllipses,
                   {.name = "error_ellipses",
                    .summary = "errors of lines or of matched poses with their empirical and their estimated ellipse",
                    .reference = ""});

}  // namespace
}  // namespace scanbench::render
