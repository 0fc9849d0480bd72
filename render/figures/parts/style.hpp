// The style of recurring things: colours, budgets, the path of the sensor, the legend of methods.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render/figure.hpp"
#include "render/palette.hpp"

namespace scanbench::render {

inline constexpr Color kWallColor = kBlack;
inline constexpr Color kScanColor = kBlue;
inline constexpr Color kPathColor = kVermillion;
inline const Color kTruthUnderlay{205, 205, 205};  ///< true walls behind coloured lines
inline const Color kFaintPoints{175, 175, 175};
inline constexpr double kPlaceSizePt = 3.0;

/// The most segments and points that all panels of one figure show, so that its SVG stays below a megabyte.
inline constexpr std::size_t kSegmentBudget = 14000;
inline constexpr std::size_t kPointBudget = 9000;

/// The path of the sensor as a line, and its legend entry; dots if it was placed at each pose.
void add_path(const FigureInput& input, std::span<const Pose2> poses, const Stroke& stroke, Panel& panel);
LegendEntry path_legend(const FigureInput& input, const Stroke& stroke);

/// The most methods that a legend lists; more are named only by the titles of their panels.
inline constexpr std::size_t kListedMethods = 4;

/// Indices 0 .. n - 1 in groups of equal elements, in the order of their first ones, so that equal results are drawn
/// once.
template <class Equal>
std::vector<std::vector<std::size_t>> groups_of_equal(std::size_t n, Equal equal) {
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < n; ++i) {
    const auto same = std::ranges::find_if(groups, [&](const auto& group) { return equal(group.front(), i); });
    if (same == groups.end())
      groups.push_back({i});
    else
      same->push_back(i);
  }
  return groups;
}

/// The pipelines of a group: "iepf, smf".
std::string names_of(const std::vector<NamedResult>& results, const std::vector<std::size_t>& group);

/// Colour of one of the results of a figure; up to seven results have different ones.
Color method_color(const std::vector<NamedResult>& results, std::size_t index);

/// A swatch for each group, in the colour of its first method, if they are few; else one entry that explains the
/// colours.
void add_method_legend(const std::vector<NamedResult>& results, const std::vector<std::vector<std::size_t>>& groups,
                       double width_pt, Scene& scene);

/// A scene of small multiples for `panels` panels on a map: width, columns, one range, a scale bar. Four panels are two
/// rows of two.
Scene small_multiples(std::size_t panels);
/// The same for the panels that the scene has.
void arrange_multiples(Scene& scene);

/// True if a panel has lines in this colour and dash, so that a legend may name them.
bool draws(const Scene& scene, const Stroke& stroke);

/// Writes into an empty panel why it is empty.
void add_note(const std::string& text, Panel& panel);

/// True if a figure whose parameter `pipeline` is `wanted` (empty: any) shows this one.
inline bool shows(std::string_view wanted, std::string_view pipeline) {
  return wanted.empty() || wanted == pipeline;
}

/// "1 line", "3 lines".
std::string counted(std::size_t n, const std::string& noun);

}  // namespace scanbench::render
