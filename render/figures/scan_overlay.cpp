// One scan, or the median and the worst one, and the lines that each pipeline found over it: small multiples in the
// sensor frame.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/registry.hpp"
#include "render/figures/parts/frames.hpp"
#include "render/figures/parts/judged_lines.hpp"
#include "render/figures/parts/style.hpp"
#include "render/figures/parts/view_box.hpp"

namespace scanbench::render {
namespace {

const Stroke kUnderlay{kTruthUnderlay, 2.6, Dash::solid};
const Stroke kSensorStroke{kGrey, 0.9, Dash::solid};
constexpr double kScanLineWidth = 1.3;

struct ShownScan {
  std::size_t frame;
  std::string rank{};  ///< "median", "worst"; empty: chosen by its number
};

/// Right lines as a share of those found and missed; 1 where there is neither.
double share_right(const ScanVerdict& verdict) {
  const auto right = std::ranges::count(verdict.lines, LineVerdict::right);
  const auto judged = std::ranges::count_if(verdict.lines, [](LineVerdict of_line) {
    return of_line != LineVerdict::unjudged && of_line != LineVerdict::too_small;
  });
  const auto all = judged + static_cast<std::ptrdiff_t>(verdict.missed.size());
  return all > 0 ? static_cast<double>(right) / static_cast<double>(all) : 1.0;
}

/// Scans by the mean of that share over all pipelines, worst first; empty if a pipeline has no verdicts.
std::vector<std::size_t> from_worst_to_best(const FigureInput& input) {
  const std::size_t frames = input.recording.observed.frames.size();
  std::vector<double> merit(frames, 0.0);
  for (const NamedResult& named : input.results) {
    if (named.verdicts.size() != frames) return {};
    for (std::size_t f = 0; f < frames; ++f) merit[f] += share_right(named.verdicts[f]);
  }
  std::vector<std::size_t> order(frames);
  for (std::size_t f = 0; f < frames; ++f) order[f] = f;
  std::ranges::stable_sort(order, {}, [&](std::size_t f) { return merit[f]; });
  return order;
}

class ScanOverlay : public Figure {
 public:
  struct Params {
    int frame = -1;
    static auto fields() {
      return std::tuple{field("frame", &Params::frame, at_least(-1), "",
                              "frame to show, from 0; -1: the median and the worst one by the share of right lines, "
                              "the middle one without truth")};
    }
  };
  explicit ScanOverlay(const Params& params) : params_(params) {}

  std::string why_nothing(const FigureInput&) const override {
    return "the recording has no scans, or no pipeline has finished";
  }

  std::vector<NamedScene> draw(const FigureInput& input) const override {
    if (input.recording.observed.frames.empty() || input.results.empty()) return {};
    const std::vector<ShownScan> shown = shown_scans(input);
    const auto groups = groups_of_equal(input.results.size(), [&](std::size_t i, std::size_t k) {
      return std::ranges::all_of(shown, [&](const ShownScan& scan) {
        return lines_of(input.results[i], scan.frame) == lines_of(input.results[k], scan.frame);
      });
    });
    Scene scene = small_multiples(groups.size() * shown.size());
    if (shown.size() == 2) scene.columns = groups.size() <= 2 ? 2 : 4;  // the two scans of a pipeline side by side
    const std::size_t frames = input.recording.observed.frames.size();
    scene.title = shown.size() == 2 ? fmt::format("{}: the median scan ({}) and the worst ({})", input.title,
                                                  shown[0].frame, shown[1].frame)
                                    : fmt::format("{}: scan {} (0 to {})", input.title, shown[0].frame, frames - 1);
    for (const auto& group : groups)
      for (const ShownScan& scan : shown) scene.panels.push_back(panel_of(input, group, scan));
    add_legend_entries(input, groups, scene);
    std::string which = fmt::format("scan {}", shown[0].frame);
    if (shown.size() == 2)
      which = fmt::format("the median scan ({}) and the worst one ({}), by the share of right lines over all pipelines",
                          shown[0].frame, shown[1].frame);
    return {
        {"scan_overlay",
         fmt::format("{}: the points of {}, and the lines that each pipeline found, sensor frame.", input.title, which),
         std::move(scene)}};
  }

 private:
  std::vector<ShownScan> shown_scans(const FigureInput& input) const {
    const std::vector<std::size_t> order = from_worst_to_best(input);
    if (params_.frame >= 0 || order.empty()) return {{shown_frame(input.recording, params_.frame)}};
    const std::size_t median = order[order.size() / 2], worst = order.front();
    if (median == worst) return {{median}};
    return {{median, "median"}, {worst, "worst"}};
  }

  static JudgedLines lines_of(const NamedResult& named, std::size_t frame) {
    JudgedLines lines;
    if (frame < named.result->lines.size()) lines.add(named.result->lines[frame], named.verdicts, frame, Pose2());
    return lines;
  }

  static bool has_truth(const Recording& recording, std::size_t frame) {
    return recording.truth && frame < recording.truth->world_from_sensor.size();
  }

  static Panel panel_of(const FigureInput& input, const std::vector<std::size_t>& group, const ShownScan& scan) {
    const NamedResult& named = input.results[group.front()];
    const Recording& recording = input.recording;
    const std::vector<Vec2> points = frame_points(recording, scan.frame, Pose2());
    const JudgedLines lines = lines_of(named, scan.frame);
    Panel panel{.tell_outside = "point"};
    const std::string which = scan.rank.empty() ? "" : fmt::format(", {}", scan.rank);
    panel.title = fmt::format("{}{}: {}", names_of(input.results, group), which, counted(lines.found().size(), "line"));
    if (has_truth(recording, scan.frame))
      panel.items.emplace_back(
          Lines{true_walls(recording, recording.truth->world_from_sensor[scan.frame].inverse()), kUnderlay});
    panel.items.emplace_back(Points{.points = points, .color = kBlack, .size_pt = 1.1});
    lines.draw({method_color(input.results, group.front()), kScanLineWidth, Dash::solid}, true, panel);
    panel.items.emplace_back(Arrow{.pose = Pose2(), .length_pt = 12, .stroke = kSensorStroke});
    // All panels of a scan have one view. It contains the points and the found lines, but not walls far away.
    std::vector<Vec2> seen = points;
    for (const NamedResult& other : input.results)
      for (const Vec2& end : ends_of(lines_of(other, scan.frame).found())) seen.push_back(end);
    const std::array sensor{Vec2(0.0, 0.0)};
    set_view(seen, sensor, panel);
    return panel;
  }

  static void add_legend_entries(const FigureInput& input, const std::vector<std::vector<std::size_t>>& groups,
                                 Scene& scene) {
    const bool judged = std::ranges::any_of(input.results, [](const NamedResult& r) { return !r.verdicts.empty(); });
    if (has_truth(input.recording, 0)) scene.legend.push_back({.text = "true walls", .stroke = kUnderlay});
    scene.legend.push_back({.text = "scan points", .marker = Marker::dot, .marker_size_pt = 2.0});
    if (judged)
      add_verdict_legend(kScanLineWidth, scene);
    else
      add_method_legend(input.results, groups, kScanLineWidth, scene);
    scene.legend.push_back({.text = "sensor", .stroke = kSensorStroke, .arrow = true});
  }

  Params params_;
};

SCANBENCH_REGISTER(Figure, ScanOverlay,
                   {.name = "scan_overlay",
                    .summary = "the median and the worst scan, and the lines that each pipeline found",
                    .reference = ""});

}  // namespace
}  // namespace scanbench::render
