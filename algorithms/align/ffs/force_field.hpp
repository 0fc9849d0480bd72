// Forces between the points of different bodies, and their potential (Lakaemper 2010, section 3, equations 1 and 2).
//
// With d = |u - v| and c = |cos| of the angle between the directions of v and u, the point v of one body is drawn
// towards the point u of another by
//
//   V(v, u) = M (u - v) / d,   M = w_v w_u c exp(-d^2 / (2 sigma^2)) / (sigma sqrt(2 pi))              (1), (2)
//
// which is minus the derivative by v of the potential -1/2 w_v w_u c erfc(d / (sigma sqrt 2)). Equation 1 prints v - u,
// which would drive scans apart; directions are those of lines, which have no sign, hence |cos|. Two points that
// coincide would pull at each other with full force in a direction that rounding chooses: nearer than soft_sigmas *
// sigma the force is proportional to d, (u - v) / (soft_sigmas * sigma) in place of (u - v) / d. docs/algorithms/ffs.md
// has the derivations.
#pragma once

#include <vector>

#include "core/geometry/geometry.hpp"

namespace scanbench::align::ffs {

/// Points of all bodies placed in one frame. All vectors have one length; everything is finite.
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

/// How far and how hard a point is drawn.
struct PointForce {
  Vec2 force = Vec2::Zero();
  double stiffness = 0.0;  ///< sum of M / max(d, soft_sigmas * sigma): the springs that a step must not overshoot
};

/// Radius of the field: `sigma` > 0; pairs beyond `cut_sigmas` standard deviations exert nothing, which leaves out
/// exp(-cut^2 / 2) of the largest force of a pair: 2.2e-3 at 3.5, 3.4e-4 at 4.
struct Field {
  double sigma = 1.0;
  double cut_sigmas = 4.0;
  double soft_sigmas = 0.05;  ///< > 0

  double reach() const { return sigma * cut_sigmas; }
  double soft() const { return sigma * soft_sigmas; }
};

/// The sum of V over all points of other bodies, per point. O(n) in memory, O(pairs within the cut) in time. Summed in
/// single precision relative to the middle of the points: relative error some 1e-5, and 1e-7 of the map's extent in
/// d. The same bytes on every x86-64, with wide registers or without.
void point_forces(const FieldPoints& points, const Field& field, std::vector<PointForce>& forces);

/// Stiffness of a point midway between points of weight 1 on a long line through it, `spacing_m` apart.
double stiffness_on_line(double spacing_m, const Field& field);

/// Potential of all pairs within the cut; 0 for no pairs, negative otherwise. Double precision, slower than the forces.
double potential(const FieldPoints& points, const Field& field);

}  // namespace scanbench::align::ffs
