// Prototype-based fuzzy clustering of points into lines: Borges & Aldon, "A split-and-merge segmentation algorithm for
// line extraction in 2-D range images", ICPR 2000, section 2.3.
#pragma once

#include <span>
#include <vector>

#include "core/geometry/geometry.hpp"

namespace scanbench::extract {

/// A prototype: the line normal . p = rho (unit normal (cos alpha, sin alpha), rho of any sign) and the weighted centre
/// of gravity of its points, to which the penalty g of eq. (10) is the distance.
struct FuzzyLine {
  Vec2 normal{1.0, 0.0};
  double rho = 0.0;
  Vec2 centre = Vec2::Zero();
};

struct FuzzyOptions {
  double fuzzifier = 2.0;             ///< m of eq. (1), > 1; the paper says only "a constant"
  bool penalty = true;                ///< include the term g of eq. (4); without it prototypes are infinite lines
  double rho_tolerance_m = 1e-3;      ///< step 4: a line has converged if it moves by at most this at its centre
  double alpha_tolerance_rad = 1e-3;  ///< and rotates by at most this, below pi/2
  int max_iterations = 100;
};

struct FuzzyLines {
  std::vector<FuzzyLine> lines;     ///< as many as there were initial ones, in their order
  std::vector<double> memberships;  ///< u_ij of eq. (6), row-major, lines x points; the lines were computed from them
  std::vector<double> costs;        ///< J of eq. (1) after the memberships and after the prototypes of each iteration;
                                    ///< it never increases
  int iterations = 0;
  bool converged = false;

  double membership(std::size_t line, std::size_t point) const {
    return memberships[line * (memberships.size() / lines.size()) + point];
  }
};

/// Alternating minimisation of eq. (1) from the given prototypes. Points are finite, in metres. Without points or
/// prototypes the result is the given prototypes. The order of the points changes the result by rounding only;
/// permuting the prototypes permutes the result. Throws ParamError for a fuzzifier that is not above 1.
FuzzyLines fuzzy_lines(std::span<const Vec2> points, std::span<const FuzzyLine> initial,
                       const FuzzyOptions& options = {});

/// The prototype of a crisp group: the orthogonal least-squares line and the centroid. If the points determine no
/// direction (one point, or an isotropic cloud), its normal is `normal_if_undefined`.
FuzzyLine prototype_of(std::span<const Vec2> points, const Vec2& normal_if_undefined);

}  // namespace scanbench::extract
