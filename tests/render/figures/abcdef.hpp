// A small recording for the tests of figures: 15 walls and a path A-B-C-D-E-F (a reconstruction of the environment in
// Borges & Aldon 2000), scanned by brute force.
#pragma once

#include "core/recording.hpp"
#include "core/result.hpp"
#include "render/figure.hpp"

namespace scanbench::render::test {

NamedPoints abcdef_waypoints();

/// `frames` scans of 451 beams over 270 degrees, sigma 5 cm, along the path.
Recording abcdef_recording(int frames);

/// One line per run of beams on one wall, `jitter_m` off: like the result of an extractor.
PipelineResult lines_by_wall_id(const Recording& recording, double jitter_m, bool with_map);

}  // namespace scanbench::render::test
