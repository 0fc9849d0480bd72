// The lines given to a merger and its map, for one pipeline: shared by the figures of merging.
#pragma once

#include <string>
#include <vector>

#include "render/figure.hpp"

namespace scanbench::render {

struct BeforeAfter {
  const NamedResult* named = nullptr;
  std::vector<Pose2> world_from_sensor;     ///< poses of the lines
  std::vector<std::vector<Segment>> given;  ///< per frame, world
  std::vector<Segment> map;

  std::size_t given_count() const;
  std::vector<Segment> all_given() const;
};

/// For the pipeline with this name; if it is empty, for the first one that has a map, else for the first one. `named`
/// is nullptr if there is none.
BeforeAfter before_after(const FigureInput& input, const std::string& pipeline);

}  // namespace scanbench::render
