// The fast caster: walls are swept over the beams of whole scans, single rays go through a tree. See
// sim/lanes/cast_kernels.hpp.
#pragma once

#include <memory>

#include "core/isa.hpp"
#include "sim/cast/caster.hpp"
#include "sim/world.hpp"

namespace scanbench::sim {

/// `isa` is for tests; the processor must support it.
std::unique_ptr<Caster> make_exact_caster(const World& world, Isa isa);

}  // namespace scanbench::sim
