// Alignment of an estimated trajectory with the true one.
#pragma once

#include <span>

#include "core/geometry/pose2.hpp"

namespace scanbench {

/// The motion of the plane, never a similarity, that brings estimated poses nearest to true ones: least squares of the
/// positions, in closed form, and of headings too, a radian counting as much as `lever_m` metres. A path that is
/// straight or stands still leaves the rotation of positions alone uncertain or open; the headings decide it then.
/// Identity for no poses. The spans have the same length.
Pose2 align_trajectories(std::span<const Pose2> estimated, std::span<const Pose2> truth, double lever_m);

}  // namespace scanbench
