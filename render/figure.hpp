// Figures: views of a recording and of the results on it, as scenes that any backend draws.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/params.hpp"
#include "core/recording.hpp"
#include "core/result.hpp"
#include "core/trace_rows.hpp"
#include "render/scene.hpp"

namespace scanbench::render {

struct NamedResult {
  std::string pipeline;
  const PipelineResult* result;
  const TraceRows* trace = nullptr;  ///< the rows that the figures ask for; absent if none were kept
};

/// Round things of a simulated world, which no line describes.
struct RoundThing {
  Vec2 center;  ///< [m], world frame
  double radius_m = 0;
};

/// What one pipeline scored over all seeds of a run, with what it was set to.
struct MeasuredPipeline {
  std::string pipeline;
  std::map<std::string, ParamSet> slots;               ///< "merge mean_shift" and the like, with all parameters
  std::map<std::string, std::string> units;            ///< of parameters, "merge.sigma_m" and the like
  std::map<std::string, std::vector<double>> metrics;  ///< of the subject "all", a finite value per seed
};

struct FigureInput {
  std::string title;  ///< the scenario's name
  const Recording& recording;
  NamedPoints waypoints;  ///< may be empty
  std::vector<RoundThing> round_things{};
  std::vector<std::vector<Vec2>> body_paths{};  ///< of bodies that move through the world
  /// Does a way lead from each pose to the next? False: the sensor was put down at each of them.
  bool continuous = true;
  std::vector<NamedResult> results;          ///< in the scenario's order; a method keeps its colour by its place here
  std::vector<MeasuredPipeline> measured{};  ///< in the scenario's order
};

struct NamedScene {
  std::string name;  ///< file name without ending
  std::string caption;
  Scene scene;
};

/// Registered in Registry<Figure>: environment, scan_overlay, ...
class Figure {
 public:
  static constexpr std::string_view kKind = "figure";
  virtual ~Figure() = default;
  /// Rows of this pipeline's trace that it draws from, "slot.name": the harness keeps them for it.
  virtual std::vector<std::string> trace_rows(std::string_view /*pipeline*/) const { return {}; }
  /// No scenes if there is nothing to show (no truth, no map).
  virtual std::vector<NamedScene> draw(const FigureInput& input) const = 0;
};

}  // namespace scanbench::render
