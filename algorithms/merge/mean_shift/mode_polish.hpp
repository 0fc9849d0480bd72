// The last part of a climb to a mode of a Gaussian kernel density, in double precision: a safeguarded Newton iteration
// on the log density. Mean shift (Lakaemper 2009, eq. 1) converges linearly and hardly moves on a plateau.
#pragma once

#include <functional>
#include <vector>

#include "algorithms/merge/parts/point_grid.hpp"

namespace scanbench::merge {

/// Points farther than this many standard deviations are not used: their weights are below 7e-10.
inline constexpr double kPolishCutoff = 6.5;

struct PolishedMode {
  Vec3 position = Vec3::Zero();
  double gradient = 0.0;   ///< length of the mean shift at the position, in standard deviations: 0 at a mode
  double curvature = 1.0;  ///< smallest eigenvalue of minus the Hessian of the log density, in (-inf, 1]
};

/// Sets `differences` to p - centre (third component: nearest image) for all points that may be within kPolishCutoff of
/// a place in centre +- kPolishBox.
using Neighbours = std::function<void(const Vec3& centre, std::vector<Vec3>& differences)>;
inline constexpr double kPolishBox = 0.25;

/// The mode uphill from `start`, in units of the standard deviation. Its gradient is zero to 1e-6 (to 1e-10 if rounding
/// permits), and it is not a saddle. The density never falls along the path. `period` as in PointGrid. Needs at least
/// one point within the cut-off.
PolishedMode polish_mode(const Vec3& start, double period, const Neighbours& neighbours);

}  // namespace scanbench::merge
