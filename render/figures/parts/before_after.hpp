// What went into a map and what came out, of one pipeline: shared by the figures of merging.
#pragma once

#include <string>
#include <vector>

#include "render/figure.hpp"

namespace scanbench::render {

struct BeforeAfter {
  const NamedResult* named = nullptr;
  std::vector<Pose2> world_from_sensor;     ///< that the lines were placed with
  std::vector<std::vector<Segment>> given;  ///< per frame, world
  std::vector<Segment> map;

  std::size_t given_count() const;
  std::vector<Segment> all_given() const;
};

/// Of the pipeline with this name; of the first one that has a map, else of the first one, if it is empty. `named` is
/// nullptr if there is none.
BeforeAfter before_after(const FigureInput& input, const std::string& pipeline);

}  // namespace scanbench::render
