// Climbing the last way to a mode of a Gaussian kernel density in double precision: a safeguarded Newton iteration on
// the log density. Mean shift itself (Lakaemper 2009, eq. 1) converges linearly and hardly moves on a plateau.
#pragma once

#include <functional>
#include <vector>

#include "algorithms/merge/parts/point_grid.hpp"

namespace scanbench::merge {

/// Beyond this many standard deviations a point does not reach a polished mode: each weighs below 7e-10 there.
inline constexpr double kPolishCutoff = 6.5;

struct PolishedMode {
  Vec3 position = Vec3::Zero();
  double gradient = 0.0;   ///< length of the mean shift at the position, in standard deviations: 0 at a mode
  double curvature = 1.0;  ///< smallest eigenvalue of minus the Hessian of the log density, in (-inf, 1]
};

/// Fills the differences p - centre (third component: nearest image) of all points that may lie within kPolishCutoff of
/// any place in centre +- kPolishBox.
using Neighbours = std::function<void(const Vec3& centre, std::vector<Vec3>& differences)>;
inline constexpr double kPolishBox = 1.0;

/// From `start`, in units of the standard deviation, uphill to a place where the gradient vanishes to 1e-6 (1e-10
/// wherever rounding lets it) and the density is no saddle. The density never falls on the way. `period` as in
/// PointGrid. Needs at least one point within reach.
PolishedMode polish_mode(const Vec3& start, double period, const Neighbours& neighbours);

}  // namespace scanbench::merge
