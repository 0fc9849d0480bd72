// The parts into which modules divide their work, so that each part can be timed.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace scanbench {

/// A part of a module's work; before the colon, the kinds of module that have it. A new part is one more enumerator
/// here and its name in stage.cpp.
enum class Stage {
  pre,         ///< extract, match: scans are prepared
  segment,     ///< extract: points are grouped into lines
  search,      ///< extract: all chains of walls are searched together
  fit,         ///< extract: lines are fitted to their points
  merge,       ///< extract, merge: lines that belong together become one
  post,        ///< extract, merge: short or unsupported lines are dropped, the result is assembled
  match,       ///< merge: pairs of lines that belong together are sought
  split,       ///< merge: long lines are cut into pieces
  phase1,      ///< merge: pieces are clustered by direction and place
  phase2,      ///< merge: pieces are clustered by collinearity
  one_by_one,  ///< align: each scan is registered against the scans before it
  joint,       ///< align: all poses are improved together
  resample,    ///< align: lines become equidistant points
  simulate,    ///< align: the scans move in the field of forces
  judge,       ///< align: the result is checked, its status decided
  start,       ///< match: a first pose by the points
  iterate,     ///< match: pairs and steps in turn
  walls,       ///< match: the walls of both scans are measured and paired
};

/// Names in the order of the enumerators; each is the enumerator's own.
std::span<const std::string_view> stage_names();
std::string_view to_string(Stage stage);
/// nullopt for text that names no stage.
std::optional<Stage> stage_named(std::string_view name);

}  // namespace scanbench
