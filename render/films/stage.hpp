// What all films share: the selection of frames, and scenes of one size.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "render/scene.hpp"

namespace scanbench::render {

inline constexpr double kFilmWidthIn = 6.4, kFilmHeightIn = 4.8;

/// At most `most` of the steps 0 .. steps - 1, evenly, with the first and the last.
inline std::vector<std::size_t> chosen_steps(std::size_t steps, std::size_t most) {
  const std::size_t frames = std::min(steps, std::max<std::size_t>(most, 2));
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < frames; ++k) chosen.push_back(frames == 1 ? 0 : k * (steps - 1) / (frames - 1));
  return chosen;
}

/// A scene of the size of all films.
inline Scene film_scene(const std::string& title, std::vector<Panel> panels, std::vector<LegendEntry> legend) {
  Scene scene{.width_in = kFilmWidthIn, .height_in = kFilmHeightIn, .title = title};
  scene.columns = static_cast<int>(panels.size());
  scene.panels = std::move(panels);
  scene.legend = std::move(legend);
  return scene;
}

}  // namespace scanbench::render
