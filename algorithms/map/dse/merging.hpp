// The merged segment of two segments and its cost (Lakaemper, Latecki & Wolter 2005, section 2.3, figure 4).
#pragma once

#include <optional>
#include <span>

#include "core/geometry/geometry.hpp"
#include "core/special_values.hpp"

namespace scanbench::mapping::dse {

/// How the cost combines the length ratio r = l(ms) / (l(p(L1)) + l(p(L2))) with the angles a_i and the sums D_i of the
/// distances of a segment's ends from the line ld. The printed formula is damaged: the numerators l_i (a_i + ...) and
/// the denominators 1 + K cos(a12) are legible, the place of r and of D_i is not.
enum class CostForm {
  ratio_of_all,        ///< r [l1 (a1 + D1) + l2 (a2 + D2)] / (1 + K cos a12)
  ratio_of_distances,  ///< [l1 (a1 + r D1) + l2 (a2 + r D2)] / (1 + K cos a12)
  ratio_added          ///< [l1 (a1 + r + D1) + l2 (a2 + r + D2)] / (1 + K cos a12)
};

struct MergeRule {
  CostForm form = CostForm::ratio_of_all;
  double k = 100.0;        ///< K, balances angles and metres
  double max_gap_m = 0.3;  ///< largest gap between the projections of the two on ld; infinity: the paper's
  /// Largest distance of an end of either from ld; infinity: the paper's. The cost weighs distances with lengths:
  /// without a limit, 10 cm of a door seen at the side of a wall join the wall, whatever its depth.
  double max_apart_m = kInf;
};

/// A segment made of two.
struct Child {
  Segment segment;
  double cost = 0.0;
  std::size_t direction = 0;  ///< index of the main direction that it follows
};

/// What a pair weighs where the line ld is placed: d1 w1 = d2 w2.
struct Weights {
  double first = 0.0;
  double second = 0.0;
};
/// The paper's: the lengths.
inline Weights lengths_of(const Segment& l1, const Segment& l2) {
  return {l1.length(), l2.length()};
}

/// ms(L1, L2, ad): the hull of the projections of both segments on the line ld, which has the direction of the unit
/// vector `ad` and lies between them so that d1 w1 = d2 w2 holds for the distances d_i of their midpoints. Its free
/// side is that of its parents. Nothing if both are nearly perpendicular to ad (the projections together have no
/// length or less than a tenth of that of the segments): ratios would be 0 / 0; or if the gap exceeds rule.max_gap_m
/// or an end's distance rule.max_apart_m.
std::optional<Child> merged(const Segment& l1, const Segment& l2, const Vec2& ad, const MergeRule& rule,
                            const Weights& weights);
inline std::optional<Child> merged(const Segment& l1, const Segment& l2, const Vec2& ad, const MergeRule& rule) {
  return merged(l1, l2, ad, rule, lengths_of(l1, l2));
}

/// The cheapest child over the main directions (unit vectors); the first of equally cheap ones.
std::optional<Child> cheapest_child(const Segment& l1, const Segment& l2, std::span<const Vec2> directions,
                                    const MergeRule& rule, const Weights& weights);
inline std::optional<Child> cheapest_child(const Segment& l1, const Segment& l2, std::span<const Vec2> directions,
                                           const MergeRule& rule) {
  return cheapest_child(l1, l2, directions, rule, lengths_of(l1, l2));
}

}  // namespace scanbench::mapping::dse
