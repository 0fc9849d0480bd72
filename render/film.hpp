// Films: scenes of equal size that show how a result comes about.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/figure.hpp"
#include "render/scene.hpp"

namespace scanbench::render {

struct Film {
  std::size_t frames = 0;
  std::function<Scene(std::size_t)> scene;  ///< of a frame, from 0; the same panels and ranges in all of them
  std::string caption;
};

/// Registered in Registry<FilmKind>: drive, map, mean_shift, alignment.
class FilmKind {
 public:
  static constexpr std::string_view kKind = "film";
  virtual ~FilmKind() = default;
  /// Rows of a pipeline's trace that it draws from, "slot.name"; `run --trace` keeps them all.
  virtual std::vector<std::string> trace_rows() const { return {}; }
  /// The film of the only result of the input, with at most `most` (>= 2) frames. It keeps references into the input.
  /// nullopt if the result has nothing of this kind.
  virtual std::optional<Film> make(const FigureInput& input, std::size_t most) const = 0;
};

}  // namespace scanbench::render
