// Figure 7 of Lakaemper, Latecki & Wolter 2005: the map of a mapper at moments around the adoption of a new main
// direction, with the directions of each moment; and all main directions against the scans.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/contracts/map_trace.hpp"
#include "core/registry.hpp"
#include "core/trace/trace_rows.hpp"
#include "render/figure.hpp"
#include "render/figures/parts/frames.hpp"
#include "render/figures/parts/style.hpp"
#include "render/figures/parts/view_box.hpp"

namespace scanbench::render {
namespace {

constexpr std::string_view kDirectionsSlot = "map";
constexpr double kSameRad = 0.0873;  // 5 degrees: directions nearer than this are one that drifts
constexpr double kSeenM = 1.0;       // length of a scan's lines that shows a direction
constexpr double kRayPt = 1.0;       // width of the rays that show directions
const Color kDirectionColor = kVermillion;
const Stroke kMapStroke{kBlue, 1.0, Dash::solid};
const Stroke kTrueWallStroke{kTruthUnderlay, 2.2, Dash::solid};
const Stroke kRayStroke{kDirectionColor, kRayPt, Dash::dashed};

/// Rows of one kind with the frame that they belong to.
template <TraceRowType Row>
std::vector<std::pair<int, Row>> framed_rows(const TraceRows& trace) {
  std::vector<std::pair<int, Row>> rows;
  if (const auto found = trace.find(key_of<Row>(kDirectionsSlot)); found != trace.end())
    for (const TraceRow& raw : found->second)
      if (const auto row = row_from<Row>(raw.values)) rows.emplace_back(raw.frame, *row);
  return rows;
}

/// The history of a map, replayed from its trace.
struct History {
  std::vector<std::pair<int, mapping::BornRow>> born;
  std::vector<std::pair<int, mapping::GoneRow>> gone;
  std::map<int, std::vector<double>> directions;  ///< by frame, strongest first

  explicit History(const TraceRows& trace)
      : born(framed_rows<mapping::BornRow>(trace)), gone(framed_rows<mapping::GoneRow>(trace)) {
    for (const auto& [frame, row] : framed_rows<mapping::DirectionRow>(trace))
      directions[frame].push_back(row.angle_rad);
  }

  /// The map after a frame.
  std::vector<Segment> map_at(int frame) const {
    std::map<int, Segment> lines;
    for (const auto& [at, row] : born)
      if (at <= frame) lines[row.line] = {{row.x1_m, row.y1_m}, {row.x2_m, row.y2_m}};
    for (const auto& [at, row] : gone)
      if (at <= frame) lines.erase(row.line);
    std::vector<Segment> segments;
    segments.reserve(lines.size());
    for (const auto& [number, segment] : lines) segments.push_back(segment);
    return segments;
  }
};

bool same(double a, double b) {
  return std::abs(wrap_direction(a - b)) <= kSameRad;
}

/// A direction that became a main one after the first scans.
struct Adoption {
  int frame = 0;
  double angle_rad = 0.0;
};

/// The first frame of the longest run of frames in which the direction is a main one: before, it may come and go.
int lasting_from(const History& history, double angle_rad) {
  int best = 0, best_length = 0, begin = 0, length = 0;
  for (const auto& [frame, angles] : history.directions) {
    if (std::ranges::none_of(angles, [&](double other) { return same(angle_rad, other); })) {
      length = 0;
      continue;
    }
    if (length++ == 0) begin = frame;
    if (length > best_length) {
      best = begin;
      best_length = length;
    }
  }
  return best;
}

/// The last direction that appears for the first time, from where it lasts.
std::optional<Adoption> last_adoption(const History& history) {
  std::optional<Adoption> last;
  std::vector<double> known;
  for (const auto& [frame, angles] : history.directions)
    for (const double angle : angles) {
      if (std::ranges::any_of(known, [&](double other) { return same(angle, other); })) continue;
      if (!known.empty()) last = {frame, angle};
      known.push_back(angle);
    }
  if (last) last->frame = lasting_from(history, last->angle_rad);
  return last;
}

class MainDirections : public Figure {
 public:
  struct Params {
    std::string pipeline;
    std::vector<double> frames;
    static auto fields() {
      return std::tuple{
          field("pipeline", &Params::pipeline, "pipeline to show; empty: the first one with such rows"),
          field("frames", &Params::frames, between(0, 1e9), "",
                "moments that are shown; empty: when a scan first sees the direction that is adopted last, the scan "
                "before it is adopted and the scan after")};
    }
  };
  explicit MainDirections(Params params) : params_(std::move(params)) {}

  std::vector<std::string> trace_rows(std::string_view pipeline) const override {
    if (!shows(params_.pipeline, pipeline)) return {};
    return {key_of<mapping::BornRow>(kDirectionsSlot), key_of<mapping::GoneRow>(kDirectionsSlot),
            key_of<mapping::DirectionRow>(kDirectionsSlot)};
  }

  std::vector<NamedScene> draw(const FigureInput& input) const override {
    for (const NamedResult& shown : input.results) {
      if (!shows(params_.pipeline, shown.pipeline) || shown.trace == nullptr) continue;
      const History history(*shown.trace);
      if (history.directions.empty()) continue;
      return {moments(input, shown, history), over_time(input, shown, history)};
    }
    return {};
  }

 private:
  /// The first frame whose scan has lines of the direction.
  static int first_seen(const Adoption& adoption, const NamedResult& shown, const std::vector<Pose2>& poses) {
    for (std::size_t k = 0; k < shown.result->lines.size() && k < poses.size(); ++k) {
      double length = 0.0;
      for (const LineFeature& line : shown.result->lines[k].lines)
        if (same((poses[k] * line.segment).direction_angle(), adoption.angle_rad)) length += line.segment.length();
      if (length >= kSeenM) return static_cast<int>(k);
    }
    return adoption.frame;
  }

  std::vector<int> chosen(const std::optional<Adoption>& adoption, int seen, int last) const {
    std::vector<int> frames;
    for (const double frame : params_.frames) frames.push_back(std::min(static_cast<int>(frame), last));
    if (frames.empty() && adoption)
      frames = {seen, std::max(adoption->frame - 1, 0), std::min(adoption->frame + 1, last)};
    if (frames.empty()) frames = {last / 3, 2 * last / 3, last};
    return frames;
  }

  NamedScene moments(const FigureInput& input, const NamedResult& shown, const History& history) const {
    const std::vector<Pose2> poses = place_frames(input.recording, shown.result).world_from_sensor;
    const std::optional<Adoption> adoption = last_adoption(history);
    const int seen = adoption ? first_seen(*adoption, shown, poses) : 0;
    Scene scene = small_multiples(3);
    scene.title = input.title + ": main directions";
    scene.columns = 3;
    const std::vector<int> frames = chosen(adoption, seen, static_cast<int>(poses.size()) - 1);
    for (const int frame : frames) scene.panels.push_back(moment(input, history, poses, frame));
    for (const auto& [text, stroke] :
         {std::pair("map", kMapStroke), std::pair("main directions", kRayStroke), std::pair("walls", kTrueWallStroke)})
      if (draws(scene, stroke)) scene.legend.push_back({.text = text, .stroke = stroke});
    std::string caption =
        fmt::format("{}: the map of {} and its main directions after scans", input.title, shown.pipeline);
    for (std::size_t i = 0; i < frames.size(); ++i) caption += fmt::format("{} {}", i == 0 ? "" : ",", frames[i]);
    caption += ".";
    if (adoption)
      caption += fmt::format(" The direction of {:.1f} deg is first seen in scan {} and adopted in scan {}.",
                             degrees(adoption->angle_rad), seen, adoption->frame);
    return {"main_directions", caption, std::move(scene)};
  }

  static Panel moment(const FigureInput& input, const History& history, const std::vector<Pose2>& poses, int frame) {
    const std::vector<Segment> map = history.map_at(frame);
    const Pose2& pose = poses[static_cast<std::size_t>(frame)];
    const auto found = history.directions.upper_bound(frame);
    std::vector<double> angles;
    if (found != history.directions.begin()) angles = std::prev(found)->second;
    Panel panel{};
    panel.items.emplace_back(Lines{.segments = true_walls(input.recording, {}), .stroke = kTrueWallStroke});
    panel.items.emplace_back(Lines{.segments = map, .stroke = kMapStroke});
    std::string text;
    Lines rays{.stroke = kRayStroke};
    const double reach = 0.15 * std::max(extent_of(map), 1.0);
    for (const double angle : angles) {
      const Vec2 along(std::cos(angle), std::sin(angle));
      rays.segments.push_back({pose.translation() - reach * along, pose.translation() + reach * along});
      text += fmt::format("{}{:.0f}", text.empty() ? "" : ", ", std::fmod(std::round(degrees(angle)), 180.0));
    }
    panel.items.emplace_back(std::move(rays));
    panel.items.emplace_back(Points{.points = {pose.translation()}, .color = kPathColor, .size_pt = kPlaceSizePt});
    panel.title = text.empty() ? fmt::format("scan {}: no direction", frame) : fmt::format("scan {}: {}°", frame, text);
    set_view(ends_of(map), ends_of(true_walls(input.recording, {})), panel);
    return panel;
  }

  /// A direction in -45 .. 135 degrees.
  static double shown_deg(double angle_rad) {
    const double deg = degrees(wrap_direction(angle_rad));
    return deg < -45.0 ? deg + 180.0 : deg;
  }

  static NamedScene over_time(const FigureInput& input, const NamedResult& shown, const History& history) {
    Scene scene{.width_in = kDoubleColumnIn, .title = input.title + ": main directions over time"};
    Panel panel{.x = {.label = "scan"}, .y = {.label = "direction [°]"}, .equal_aspect = false};
    Points strongest{.color = kBlue, .size_pt = 1.6}, others{.color = kVermillion, .size_pt = 1.6};
    for (const auto& [frame, angles] : history.directions)
      for (std::size_t k = 0; k < angles.size(); ++k)
        (k == 0 ? strongest : others).points.emplace_back(frame, shown_deg(angles[k]));
    panel.y.range = {-50.0, 140.0};  // 0 and 90 degrees, the usual ones, are inside
    panel.y.ticks = {{-45, "\u221245"}, {0, "0"}, {45, "45"}, {90, "90"}, {135, "135"}};
    const auto dot = [](const char* text, Color color) {
      return LegendEntry{.text = text, .marker = Marker::dot, .marker_color = color, .marker_size_pt = 3.0};
    };
    scene.legend = {dot("strongest", kBlue)};
    if (!others.points.empty()) scene.legend.push_back(dot("other main directions", kVermillion));
    panel.items.emplace_back(std::move(others));
    panel.items.emplace_back(std::move(strongest));
    scene.panels.push_back(std::move(panel));
    scene.box_aspect = 0.4;
    return {"main_directions_over_time",
            fmt::format("{}: the main directions that {} merged each scan with.", input.title, shown.pipeline),
            std::move(scene)};
  }

  Params params_;
};

SCANBENCH_REGISTER(
    Figure, MainDirections,
    {.name = "main_directions",
     .summary = "the map at three moments around the adoption of a main direction, and all main directions over time",
     .reference = "Lakaemper, Latecki & Wolter 2005, figure 7"});

}  // namespace
}  // namespace scanbench::render
