// Forces between the points of different bodies, and their potential (Lakaemper 2010, section 3, equations 1 and 2).
//
// With d = |u - v| and c = |cos| of the angle between the directions of v and u, the point u of one body attracts the
// point v of another with the force
//
//   V(v, u) = M (u - v) / d,   M = w_v w_u c exp(-d^2 / (2 sigma^2)) / (sigma sqrt(2 pi))              (1), (2)
//
// It is minus the derivative by v of the potential -1/2 w_v w_u c erfc(d / (sigma sqrt 2)). Equation 1 prints v - u,
// which would push scans apart. The formula has |cos|, because directions are those of lines, which have no sign. Two
// coincident points would attract each other with full force in a direction that depends on rounding. At distances
// below soft_sigmas * sigma the force is therefore proportional to d: (u - v) / (soft_sigmas * sigma) replaces (u - v)
// / d. docs/algorithms/ffs.md has the derivations.
#pragma once

#include <vector>

#include "core/geometry/geometry.hpp"
#include "core/isa.hpp"

namespace scanbench::align::ffs {

/// Points of all bodies, placed in one frame. All vectors have the same length, and all values are finite.
struct FieldPoints {
  std::vector<Vec2> at;
  std::vector<Vec2> direction;  ///< unit
  std::vector<double> weight;   ///< >= 0
  std::vector<int> body;        ///< points of one body do not attract each other

  std::size_t size() const { return at.size(); }
  void add(const Vec2& p, const Vec2& along, double w, int of_body) {
    at.push_back(p);
    direction.push_back(along);
    weight.push_back(w);
    body.push_back(of_body);
  }
  /// Keeps the first n <= size() points.
  void truncate(std::size_t n) {
    at.resize(n);
    direction.resize(n);
    weight.resize(n);
    body.resize(n);
  }
};

/// Force on a point and its stiffness.
struct PointForce {
  Vec2 force = Vec2::Zero();
  double stiffness = 0.0;  ///< sum of M / max(d, soft_sigmas * sigma): limits the step, which must not overshoot
};

/// Width of the field: `sigma` > 0. Pairs beyond `cut_sigmas` standard deviations exert no force. This omits forces
/// below exp(-cut^2 / 2) of the largest force of a pair: 2.2e-3 at 3.5, 3.4e-4 at 4.
struct Field {
  double sigma = 1.0;
  double cut_sigmas = 4.0;
  double soft_sigmas = 0.05;  ///< > 0

  double reach() const { return sigma * cut_sigmas; }
  double soft() const { return sigma * soft_sigmas; }
};

/// The sum of V over all points of other bodies, for each point. Takes O(n) memory and O(pairs within the cut) time.
/// Sums are in single precision relative to the middle of the points; their relative error is about 1e-5, and the error
/// of d is 1e-7 of the extent of the map. Results are the same bytes on every x86-64, independent of the register
/// width.
void point_forces(const FieldPoints& points, const Field& field, std::vector<PointForce>& forces, Isa isa = best_isa());

/// Stiffness of a point midway between points of weight 1 on a long line through it, `spacing_m` apart.
double stiffness_on_line(double spacing_m, const Field& field);

/// Potential of all pairs within the cut; 0 for no pairs, negative otherwise. Double precision, slower than the forces.
double potential(const FieldPoints& points, const Field& field);

}  // namespace scanbench::align::ffs
