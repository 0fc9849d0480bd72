// Chooses colours that differ between neighbours, and draws the segments and numbers of clusters in them.
#include "render/figures/parts/clusters.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/figures/parts/style.hpp"

namespace scanbench::render {
namespace {

constexpr std::array kClusterColors{kBlue, kVermillion, kGreen, kPurple, kOrange, kSky, kBlack};
constexpr std::size_t kMostNumbers = 60;  // more cannot be read at a column's width

std::size_t stride_for(std::size_t all, std::size_t most) {
  return std::max<std::size_t>(1, (all + most - 1) / most);
}

Color darkened(Color c) {  // for text, because a line's colour is too pale for thin strokes
  const auto dark = [](std::uint8_t v) { return static_cast<std::uint8_t>(0.72 * v); };
  return {dark(c.r), dark(c.g), dark(c.b)};
}

}  // namespace

std::vector<Color> cluster_colors(std::span<const Vec2> places) {
  std::vector<Color> colors;
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::array<double, kClusterColors.size()> nearest{};
    nearest.fill(INFINITY);
    for (std::size_t k = 0; k < i; ++k)
      nearest[chosen[k]] = std::min(nearest[chosen[k]], (places[k] - places[i]).squaredNorm());
    chosen.push_back(static_cast<std::size_t>(std::max_element(nearest.begin(), nearest.end()) - nearest.begin()));
    colors.push_back(kClusterColors[chosen.back()]);
  }
  return colors;
}

ClusteredSegments::ClusteredSegments(std::vector<Segment> segments, std::vector<int> cluster)
    : segments_(std::move(segments)), cluster_(std::move(cluster)) {
  cluster_.resize(segments_.size(), -1);
  int clusters = 0;
  for (const int c : cluster_) clusters = std::max(clusters, c + 1);
  places_.assign(static_cast<std::size_t>(clusters), Vec2::Zero());
  std::vector<double> members(places_.size(), 0.0);
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    if (cluster_[i] < 0) continue;
    const auto c = static_cast<std::size_t>(cluster_[i]);
    members[c] += 1.0;
    places_[c] += (segments_[i].midpoint() - places_[c]) / members[c];
  }
  colors_ = cluster_colors(places_);
}

void ClusteredSegments::add_segments(double width_pt, std::size_t most, Panel& panel) const {
  Lines none{.stroke = {kFaintPoints, width_pt, Dash::solid}};
  std::array<Lines, kClusterColors.size()> lines;
  for (std::size_t k = 0; k < lines.size(); ++k) lines[k].stroke = {kClusterColors[k], width_pt, Dash::solid};
  for (std::size_t i = 0; i < segments_.size(); i += stride_for(segments_.size(), most)) {
    Lines* into = &none;
    if (cluster_[i] >= 0)
      into = &*std::ranges::find(lines, colors_[static_cast<std::size_t>(cluster_[i])],
                                 [](const Lines& l) { return l.stroke.color; });
    into->segments.push_back(segments_[i]);
  }
  if (!none.segments.empty()) panel.items.emplace_back(std::move(none));
  for (Lines& l : lines)
    if (!l.segments.empty()) panel.items.emplace_back(std::move(l));
}

bool ClusteredSegments::add_numbers(Panel& panel) const {
  const auto inside = [](const Axis& axis, double v) {
    return !axis.range || (v >= axis.range->first && v <= axis.range->second);
  };
  // A number is beside the visible midpoint nearest to the mean of all, because the mean itself may be off the
  // segments.
  std::vector<std::optional<Vec2>> beside(places_.size());
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const Vec2 m = segments_[i].midpoint();
    if (cluster_[i] < 0 || !inside(panel.x, m.x()) || !inside(panel.y, m.y())) continue;
    const auto c = static_cast<std::size_t>(cluster_[i]);
    if (!beside[c] || (m - places_[c]).squaredNorm() < (*beside[c] - places_[c]).squaredNorm()) beside[c] = m;
  }
  if (static_cast<std::size_t>(std::ranges::count_if(beside, [](const auto& b) { return b.has_value(); })) >
      kMostNumbers)
    return false;
  for (std::size_t c = 0; c < beside.size(); ++c)
    if (beside[c])
      panel.items.emplace_back(Text{.at = *beside[c], .text = std::to_string(c + 1), .color = darkened(colors_[c])});
  return true;
}

std::vector<Segment> thinned(std::span<const Segment> segments, std::size_t most) {
  std::vector<Segment> some;
  for (std::size_t i = 0; i < segments.size(); i += stride_for(segments.size(), most)) some.push_back(segments[i]);
  return some;
}

std::vector<Vec2> thinned(std::span<const Vec2> points, std::size_t most) {
  std::vector<Vec2> some;
  for (std::size_t i = 0; i < points.size(); i += stride_for(points.size(), most)) some.push_back(points[i]);
  return some;
}

}  // namespace scanbench::render
