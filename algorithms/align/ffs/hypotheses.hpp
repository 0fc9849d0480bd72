// Hypotheses about the map: lines and rectangles. They are detected in every iteration from real data only, plotted as
// a virtual scan, and tracked over iterations for the trace (Lakaemper 2010, sections 4 and 5).
#pragma once

#include <string_view>
#include <vector>

#include "algorithms/align/ffs/hough_lines.hpp"
#include "algorithms/align/ffs/prototypes.hpp"
#include "algorithms/align/ffs/rectangles.hpp"
#include "algorithms/align/ffs/simulation.hpp"

namespace scanbench::align::ffs {

enum class Shape { line = 0, rectangle = 1 };
enum class Fate { born = 0, confirmed = 1, changed = 2, dropped = 3 };

struct Hypothesis {
  Shape shape = Shape::line;
  std::vector<Vec2> corners;  ///< the two ends of a line, the four corners of a rectangle
  double certainty = 0.0;     ///< 0 .. 1
  int id = -1;                ///< equal for hypotheses of consecutive iterations that are taken for the same
};

struct HypothesisRules {
  HoughRules lines;
  RectangleRules rectangles;
  PrototypeRules prototypes;
  double line_weight = 1.0;  ///< weight of a virtual point on a line of certainty 1; a real point has weight 1
  double rectangle_weight = 1.0;
  double resample_m = 0.1;
};

/// Lines and rectangles of the current map.
std::vector<Hypothesis> hypotheses_of(const CurrentMap& map, const HypothesisRules& rules);

/// Plots hypotheses at the density of the real points. The weight of their points is the strength of the kind times the
/// certainty. Hypotheses of weight 0 are not plotted.
VirtualScan plotted(const std::vector<Hypothesis>& hypotheses, const HypothesisRules& rules);

/// Tracks hypotheses. Each takes the id of the nearest one of its kind in the last iteration if no corner is more than
/// five resampling steps away (for a line: if neither end is farther from the other line). Its fate is "confirmed"
/// within one step, otherwise "changed".
class HypothesisJournal {
 public:
  explicit HypothesisJournal(double step_m) : step_m_(step_m) {}

  /// Assigns ids and writes a trace row `hypothesis` for each, and for each that is dropped: iteration, shape, id,
  /// fate, certainty, x1, y1 .. x4, y4 (for a line the second end three times), world frame.
  void follow(const CurrentMap& map, std::vector<Hypothesis>& hypotheses, Trace& trace);

 private:
  double step_m_;
  std::vector<Hypothesis> last_;
  int next_id_ = 0;
};

}  // namespace scanbench::align::ffs
