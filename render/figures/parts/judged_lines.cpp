// Draws lines by verdict, in colours, dashes and markers that differ for colour-blind readers and in grey print.
#include "render/figures/parts/judged_lines.hpp"

#include <string>

#include "render/figures/parts/style.hpp"

namespace scanbench::render {
namespace {

struct Look {
  const char* name;
  Color color;
  Dash dash;
  double width;  ///< relative to that of right lines
  Marker marker;
  bool filled;
};

constexpr std::size_t kUnjudged = 3, kTooSmall = 4, kMissed = 5, kOwn = 6;
constexpr std::array<Look, 6> kVerdictLooks{{{"right", kGreen, Dash::solid, 1.0, Marker::circle, true},
                                             {"split", kOrange, Dash::dashed, 1.2, Marker::square, true},
                                             {"false", kVermillion, Dash::dotted, 1.5, Marker::cross, true},
                                             {"too short to judge", kGrey, Dash::solid, 0.6, Marker::none, true},
                                             {"wall too small to judge", kSky, Dash::dashed, 1.0, Marker::none, true},
                                             {"missed", kPurple, Dash::dash_dot, 1.5, Marker::diamond, false}}};

std::size_t kind_of(LineVerdict verdict) {
  switch (verdict) {
    case LineVerdict::right:
      return 0;
    case LineVerdict::split:
      return 1;
    case LineVerdict::false_line:
      return 2;
    case LineVerdict::too_small:
      return kTooSmall;
    default:
      return kUnjudged;
  }
}

constexpr double kEndPt = 2.8;

}  // namespace

void JudgedLines::add(const ScanLines& lines, const std::vector<ScanVerdict>& verdicts, std::size_t frame,
                      const Pose2& pose) {
  const ScanVerdict* verdict = frame < verdicts.size() ? &verdicts[frame] : nullptr;
  for (std::size_t k = 0; k < lines.lines.size(); ++k) {
    const bool judged = verdict != nullptr && k < verdict->lines.size();
    lines_[judged ? kind_of(verdict->lines[k]) : kOwn].push_back(pose * lines.lines[k].segment);
  }
  if (verdict == nullptr) return;
  for (const Segment& s : verdict->missed) lines_[kMissed].push_back(pose * s);
}

std::vector<Segment> JudgedLines::found() const {
  std::vector<Segment> all;
  for (std::size_t kind = 0; kind < kKinds; ++kind)
    if (kind != kMissed) all.insert(all.end(), lines_[kind].begin(), lines_[kind].end());
  return all;
}

void JudgedLines::draw(const Stroke& own, bool ends, Panel& panel) const {
  // Draws usual verdicts before rare ones, so that nothing rare is hidden; missed lines are below all, where no found
  // line is.
  for (const std::size_t kind : {kMissed, kUnjudged, kTooSmall, std::size_t{0}, std::size_t{1}, std::size_t{2}, kOwn}) {
    if (lines_[kind].empty()) continue;
    const Look look = kind == kOwn ? Look{"", own.color, own.dash, 1.0, Marker::circle, true} : kVerdictLooks[kind];
    panel.items.emplace_back(
        Lines{.segments = lines_[kind], .stroke = {look.color, look.width * own.width_pt, look.dash}});
    if (!ends || look.marker == Marker::none) continue;
    Points tips{.marker = look.marker, .color = look.color, .size_pt = kEndPt, .filled = look.filled};
    for (const Segment& s : lines_[kind]) tips.points.insert(tips.points.end(), {s.a, s.b});
    panel.items.emplace_back(std::move(tips));
  }
}

void add_verdict_legend(double width_pt, Scene& scene) {
  for (const Look& look : kVerdictLooks) {
    const Stroke stroke{look.color, look.width * width_pt, look.dash};
    if (!draws(scene, stroke)) continue;
    scene.legend.push_back({.text = look.name,
                            .stroke = stroke,
                            .marker = look.marker,
                            .marker_color = look.color,
                            .marker_size_pt = kEndPt,
                            .marker_filled = look.filled});
  }
}

}  // namespace scanbench::render
