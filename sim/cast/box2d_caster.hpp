// The reference caster: Box2D's broad phase names the surfaces near a ray, double arithmetic says which is hit and how
// far it is.
#pragma once

#include <memory>

#include "sim/cast/caster.hpp"
#include "sim/world.hpp"

namespace scanbench::sim {

/// One ray at a time. Box2D's narrow phase is not used: its floats lose grazing rays, and choose the wrong one of two
/// walls at nearly one distance.
std::unique_ptr<Caster> make_box2d_caster(const World& world);

}  // namespace scanbench::sim
