// Figures: views of a recording and of the results on it, as scenes that any backend draws.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
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
  unjudged,    ///< too short to count
  too_small    ///< right, but on a wall too small to count
};

struct ScanVerdict {
  std::vector<LineVerdict> lines;  ///< of the lines found, in their order
  std::vector<Segment> missed;     ///< true lines that no line explains, sensor frame
};

/// The lines that a pipeline found beside the true walls, drawn as pixels (the metric family raster_truth).
struct PixelDifference {
  std::vector<Segment> right{};   ///< parts of found lines near a wall, world frame
  std::vector<Segment> wrong{};   ///< the other parts of found lines
  std::vector<Segment> missed{};  ///< visible parts of walls without a found line near them
  std::int64_t right_pixels = 0;
  std::int64_t wrong_pixels = 0;
  std::int64_t missed_pixels = 0;
  double pixel_m = 0;      ///< side of a pixel
  double tolerance_m = 0;  ///< what counts as near
};

struct NamedResult {
  std::string pipeline;
  const PipelineResult* result;
  const TraceRows* trace = nullptr;             ///< the rows that the figures request; absent if none were kept
  std::vector<ScanVerdict> verdicts{};          ///< per frame; empty without truth
  std::optional<PixelDifference> difference{};  ///< if a figure compares_pixels(), and there is a truth
};

/// A round object of a simulated world.
struct RoundObject {
  Vec2 center;  ///< [m], world frame
  double radius_m = 0;
};

/// Which values of a metric are good, and what a figure writes beside them.
struct MetricLook {
  enum class Best { lowest, highest, target, none };
  std::string label{};  ///< words for axes and titles, without the unit
  std::string unit{};
  Best best = Best::none;
  double target = 0.0;     ///< for Best::target
  double tolerance = 0.0;  ///< differences up to this do not matter
};

/// A mean over the seeds with its 95 % interval.
struct MeanBand {
  double mean = 0, low = 0, high = 0;
  bool is_range = false;  ///< low and high are the smallest and the largest value, too few for an interval
};

/// The name among the metrics of a pipeline of the CPU time [s] of all its stages for one scan.
inline constexpr std::string_view kScanTime = "scan_time";

/// The metrics of one pipeline over all seeds of a run, with its parameters.
struct MeasuredPipeline {
  std::string pipeline;
  std::map<std::string, ParamSet> slots;     ///< "merge mean_shift" and the like, with all parameters
  std::map<std::string, std::string> units;  ///< of parameters, "merge.sigma_m" and the like
  /// A finite value per seed: of the subject "all", else "mean", else the mean over the subjects.
  std::map<std::string, std::vector<double>> metrics;
  /// The same with a value for every seed of the scenario in its order: NaN where it is undefined or the cell failed.
  std::map<std::string, std::vector<double>> by_seed{};
  std::map<std::string, MeanBand> bands{};  ///< of the finite values
};

/// All pipelines of one scenario.
struct MeasuredScenario {
  std::string name;
  std::vector<MeasuredPipeline> pipelines{};
};

struct FigureInput {
  std::string title;  ///< the scenario's name
  const Recording& recording;
  NamedPoints waypoints;  ///< may be empty
  std::vector<RoundObject> circles{};
  std::vector<std::vector<Vec2>> body_paths{};  ///< of bodies that move through the world
  /// True if the sensor moves from each pose to the next; false if it is placed at each of them.
  bool continuous = true;
  std::vector<NamedResult> results;           ///< in the scenario's order
  std::vector<MeasuredPipeline> measured{};   ///< in the scenario's order
  std::map<std::string, MetricLook> looks{};  ///< of the metrics in `measured`
  std::string quality{};                      ///< the metric by which reports rank these pipelines; empty: none
  std::vector<MeasuredScenario> scenarios{};  ///< of the whole run; only for a figure that spans_scenarios()
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
  /// True if it shows NamedResult::difference, which the harness then computes.
  virtual bool compares_pixels() const { return false; }
  /// True if it shows results of all seeds, and not of the first alone.
  virtual bool spans_seeds() const { return false; }
  /// True if it is drawn once for a whole run, from FigureInput::scenarios alone.
  virtual bool spans_scenarios() const { return false; }
  /// No scenes if there is nothing to show (no truth, no map).
  virtual std::vector<NamedScene> draw(const FigureInput& input) const = 0;
  /// Why draw() gives no scenes for this input, for people.
  virtual std::string why_nothing(const FigureInput& /*input*/) const {
    return "the recording and the results have nothing that it shows";
  }
};

}  // namespace scanbench::render
