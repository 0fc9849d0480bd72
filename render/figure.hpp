// Figures: views of a recording and of the results on it, as scenes that any backend draws.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/params.hpp"
#include "core/recording.hpp"
#include "core/result.hpp"
#include "core/trace/trace_rows.hpp"
#include "render/scene.hpp"

namespace scanbench::render {

/// How a line found in a scan compares with the true lines of that scan.
enum class LineVerdict {
  right,
  split,       ///< agrees with a true line that another line already explains
  false_line,  ///< agrees with none
  unjudged     ///< too short to count
};

struct ScanVerdict {
  std::vector<LineVerdict> lines;  ///< of the lines found, in their order
  std::vector<Segment> missed;     ///< true lines that no line explains, sensor frame
};

struct NamedResult {
  std::string pipeline;
  const PipelineResult* result;
  const TraceRows* trace = nullptr;     ///< the rows that the figures request; absent if none were kept
  std::vector<ScanVerdict> verdicts{};  ///< per frame; empty without truth
};

/// A round object of a simulated world.
struct Circle {
  Vec2 center;  ///< [m], world frame
  double radius_m = 0;
};

/// The metrics of one pipeline over all seeds of a run, with its parameters.
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
  std::vector<Circle> circles{};
  std::vector<std::vector<Vec2>> body_paths{};  ///< of bodies that move through the world
  /// True if the sensor moves from each pose to the next; false if it is placed at each of them.
  bool continuous = true;
  std::vector<NamedResult> results;          ///< in the scenario's order
  std::vector<MeasuredPipeline> measured{};  ///< in the scenario's order
};

struct NamedScene {
  std::string name;  ///< file name without extension
  std::string caption;
  Scene scene;
};

/// Registered in Registry<Figure>: environment, scan_overlay, ...
class Figure {
 public:
  static constexpr std::string_view kKind = "figure";
  virtual ~Figure() = default;
  /// Rows of this pipeline's trace that it draws from, "slot.name". The harness keeps them.
  virtual std::vector<std::string> trace_rows(std::string_view /*pipeline*/) const { return {}; }
  /// No scenes if there is nothing to show (no truth, no map).
  virtual std::vector<NamedScene> draw(const FigureInput& input) const = 0;
  /// Why draw() gives no scenes for this input, for people.
  virtual std::string why_nothing(const FigureInput& /*input*/) const {
    return "the recording and the results have nothing that it shows";
  }
};

}  // namespace scanbench::render
