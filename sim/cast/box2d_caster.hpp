// The reference caster: Box2D's broad phase finds the surfaces near a ray, double arithmetic decides which is hit and
// at what range.
#pragma once

#include <memory>

#include "sim/cast/caster.hpp"
#include "sim/world.hpp"

namespace scanbench::sim {

/// Casts one ray at a time. Box2D's narrow phase is not used, because its floats lose grazing rays and choose the wrong
/// one of two walls at nearly the same distance.
std::unique_ptr<Caster> make_box2d_caster(const World& world);

}  // namespace scanbench::sim
