// The looks of recurring things: colours, budgets, the path of the sensor, the legend of methods.
#pragma once

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

/// How many segments or points all panels of one figure may show: an SVG of them stays below a megabyte.
inline constexpr std::size_t kSegmentBudget = 14000;
inline constexpr std::size_t kPointBudget = 9000;

/// The path of the sensor as a line, and its legend entry; dots where it was put down at each pose.
void add_path(const FigureInput& input, std::span<const Pose2> poses, const Stroke& stroke, Panel& panel);
LegendEntry path_legend(const FigureInput& input, const Stroke& stroke);

/// How many methods have a colour each; more share one, because each has a panel of its own.
inline constexpr std::size_t kColoredMethods = 4;

/// The colour of method i of the results: what add_method_legend() says.
Color method_color(const std::vector<NamedResult>& results, std::size_t i);

/// A swatch per method in its colour; one for all, "lines found", if there are more than four.
void add_method_legend(const std::vector<NamedResult>& results, double width_pt, Scene& scene);

/// A scene of small multiples for `panels` panels: width and columns.
Scene small_multiples(std::size_t panels);

/// An empty panel says why it is empty.
void add_note(const std::string& text, Panel& panel);

/// Does a figure whose parameter `pipeline` is `wanted` (empty: any) show this one?
inline bool shows(std::string_view wanted, std::string_view pipeline) {
  return wanted.empty() || wanted == pipeline;
}

/// "1 line", "3 lines".
std::string counted(std::size_t n, const std::string& noun);

}  // namespace scanbench::render
