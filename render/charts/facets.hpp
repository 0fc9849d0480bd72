// Small multiples of curves: one panel for each method, with the curves of the others in grey behind it. A dozen
// methods need no legend of a dozen colours, and each can still be compared with all.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "render/scene.hpp"

namespace scanbench::render {

/// Points in the order of x, each with the interval [low, high] about it.
struct FacetCurve {
  std::vector<Vec2> points{};
  std::vector<std::array<double, 3>> intervals{};  ///< x, low, high
};

struct Facet {
  std::string title{};
  std::vector<FacetCurve> curves{};  ///< at most two: discs, then hollow squares
  std::vector<Vec2> reference{};     ///< a line to compare them with; may be empty
};

struct FacetChart {
  std::string title{};
  Axis x{};
  Axis y{};
  std::vector<Facet> facets{};
  std::vector<std::string> curve_names{};  ///< for the legend, as many as a facet has curves
  std::string reference_name{};            ///< empty: no reference
  std::string others_name{};               ///< of the first curves of all others, in grey; empty: not drawn
};

/// The range of a logarithmic axis that contains the points of the curves, but not their intervals. Between a point and
/// the edge of a panel is room for the arrow that ends an interval which leaves the panel.
std::pair<double, double> log_range(const std::vector<Facet>& facets, int coordinate);

/// Four columns, five for more than a dozen facets, at the width of two text columns, so labels of the x axis must be
/// short. Facets without points keep their cell.
Scene facet_scene(const FacetChart& chart);

}  // namespace scanbench::render
