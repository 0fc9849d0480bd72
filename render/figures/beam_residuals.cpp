// The residuals of one scan along its beams, exaggerated: how much farther or nearer each return is than the line that
// it supports. A bend in the residuals of a line is a wall that is not straight, a line over two walls or a wrong end.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/registry.hpp"
#include "render/figures/parts/frames.hpp"
#include "render/figures/parts/style.hpp"
#include "render/figures/parts/view_box.hpp"

namespace scanbench::render {
namespace {

const Stroke kLine{kBlack, 0.8, Dash::solid};
constexpr Color kFarther = kBlue, kNearer = kVermillion;
constexpr double kStemPt = 0.5;
constexpr double kResidualDotPt = 1.6;

/// Where a beam meets its line, and the return's distance beyond that [m].
struct Residual {
  Vec2 foot;
  Vec2 direction;
  double beyond_m;
};

class BeamResiduals : public Figure {
 public:
  struct Params {
    std::string pipeline;
    int frame = -1;
    double exaggeration = 20.0;
    static auto fields() {
      return std::tuple{
          field("pipeline", &Params::pipeline, "pipeline whose lines are shown; empty: all"),
          field("frame", &Params::frame, at_least(-1), "", "frame that is shown, from 0; -1: the middle one"),
          field("exaggeration", &Params::exaggeration, above(0), "", "length on paper of a residual over its own")};
    }
  };
  explicit BeamResiduals(const Params& params) : params_(params) {}

  std::string why_nothing(const FigureInput&) const override {
    return "no pipeline has a line with beams that support it in this scan";
  }

  std::vector<NamedScene> draw(const FigureInput& input) const override {
    if (input.recording.observed.frames.empty()) return {};
    const std::size_t frame = shown_frame(input.recording, params_.frame);
    const Scan scan = input.recording.observed.scan(frame);
    std::vector<Panel> panels;
    for (const NamedResult& named : input.results) {
      if (!shows(params_.pipeline, named.pipeline) || frame >= named.result->lines.size()) continue;
      const ScanLines& lines = named.result->lines[frame];
      const std::vector<Residual> residuals = residuals_of(scan, lines);
      if (!residuals.empty()) panels.push_back(panel_of(named.pipeline, lines, residuals));
    }
    if (panels.empty()) return {};
    Scene scene = small_multiples(panels.size());
    scene.title = fmt::format("{}: residuals of scan {}, {:g} times as long", input.title, frame, params_.exaggeration);
    scene.panels = std::move(panels);
    scene.legend = {{.text = "lines", .stroke = kLine},
                    {.text = "return behind its line",
                     .stroke = Stroke{kFarther, kStemPt, Dash::solid},
                     .marker = Marker::dot,
                     .marker_color = kFarther,
                     .marker_size_pt = kResidualDotPt},
                    {.text = "before it",
                     .stroke = Stroke{kNearer, kStemPt, Dash::solid},
                     .marker = Marker::dot,
                     .marker_color = kNearer,
                     .marker_size_pt = kResidualDotPt}};
    return {{"beam_residuals",
             fmt::format("{}: scan {}, sensor frame. The stems are the residuals of the returns along their beams from "
                         "the lines that they support, drawn {:g} times as long.",
                         input.title, frame, params_.exaggeration),
             std::move(scene)}};
  }

 private:
  static std::vector<Residual> residuals_of(const Scan& scan, const ScanLines& lines) {
    std::vector<Residual> residuals;
    const auto beams = std::min<std::size_t>(static_cast<std::size_t>(scan.beams()), lines.labels.size());
    for (std::size_t i = 0; i < beams; ++i) {
      const int beam = static_cast<int>(i), label = lines.labels[i];
      if (label < 0 || static_cast<std::size_t>(label) >= lines.lines.size() || !scan.valid(beam)) continue;
      const PolarLine& line = lines.lines[static_cast<std::size_t>(label)].line;
      const Vec2 direction = scan.sensor.geometry.direction(beam);
      const double range = line.rho / line.normal().dot(direction);
      const double beyond = scan.point(beam).norm() - range;
      if (range > 0 && std::isfinite(beyond)) residuals.push_back({range * direction, direction, beyond});
    }
    return residuals;
  }

  Panel panel_of(const std::string& name, const ScanLines& lines, const std::vector<Residual>& residuals) const {
    double squares = 0.0;
    Lines farther{.stroke = {kFarther, kStemPt, Dash::solid}}, nearer{.stroke = {kNearer, kStemPt, Dash::solid}};
    Points far_tips{.color = kFarther, .size_pt = kResidualDotPt},
        near_tips{.color = kNearer, .size_pt = kResidualDotPt};
    std::vector<Vec2> tips;
    for (const Residual& r : residuals) {
      squares += r.beyond_m * r.beyond_m;
      const Vec2 tip = r.foot + params_.exaggeration * r.beyond_m * r.direction;
      (r.beyond_m < 0 ? nearer : farther).segments.push_back({r.foot, tip});
      (r.beyond_m < 0 ? near_tips : far_tips).points.push_back(tip);
      tips.push_back(tip);
    }
    const double rms = std::sqrt(squares / static_cast<double>(residuals.size()));
    Panel panel{.title = fmt::format("{}: {}, rms {:.1f} mm", name, counted(residuals.size(), "return"), 1000 * rms),
                .tell_outside = "point"};
    Lines found{.stroke = kLine};
    for (const LineFeature& line : lines.lines) found.segments.push_back(line.segment);
    set_view(tips, ends_of(found.segments), panel);
    panel.items.emplace_back(std::move(farther));
    panel.items.emplace_back(std::move(nearer));
    panel.items.emplace_back(std::move(far_tips));
    panel.items.emplace_back(std::move(near_tips));
    panel.items.emplace_back(std::move(found));
    panel.items.emplace_back(Arrow{.pose = Pose2(), .length_pt = 12, .stroke = {kGrey, 1.0, Dash::solid}});
    return panel;
  }

  Params params_;
};

SCANBENCH_REGISTER(Figure, BeamResiduals,
                   {.name = "beam_residuals",
                    .summary = "residuals of one scan along its beams from the lines that they support, exaggerated",
                    .reference = ""});

}  // namespace
}  // namespace scanbench::render
