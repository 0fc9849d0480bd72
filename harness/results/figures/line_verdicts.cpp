// Converts the line matching of metrics/ to the verdicts of render/.
#include "harness/results/figures/line_verdicts.hpp"

#include <algorithm>

#include "core/params.hpp"
#include "metrics/judged_scan.hpp"

namespace scanbench::results {
namespace {

render::LineVerdict verdict_of(metrics::Outcome outcome) {
  switch (outcome) {
    case metrics::Outcome::true_line:
      return render::LineVerdict::right;
    case metrics::Outcome::split:
      return render::LineVerdict::split;
    case metrics::Outcome::false_line:
      return render::LineVerdict::false_line;
    case metrics::Outcome::too_small:
      return render::LineVerdict::too_small;
    default:
      return render::LineVerdict::unjudged;
  }
}

}  // namespace

std::vector<render::ScanVerdict> line_verdicts(const Recording& recording, const PipelineResult& result,
                                               const metrics::SegmentRules& rules) {
  const metrics::MetricInput input{recording.observed, recording.truth ? &*recording.truth : nullptr, result};
  const std::size_t frames = recording.observed.frames.size();
  if (!metrics::has_beam_truth(input) || result.lines.size() != frames) return {};
  const metrics::Surfaces surfaces = metrics::join_walls(recording.truth->walls);
  std::vector<render::ScanVerdict> verdicts(frames);
  for (std::size_t f = 0; f < frames; ++f) {
    const auto [truth, matching] = metrics::judge_scan(input, f, surfaces, rules);
    for (const metrics::Outcome outcome : matching.outcome) verdicts[f].lines.push_back(verdict_of(outcome));
    for (std::size_t t = 0; t < truth.size(); ++t)
      if (std::ranges::find(matching.truth, static_cast<int>(t)) == matching.truth.end())
        verdicts[f].missed.push_back(truth[t].segment);
  }
  return verdicts;
}

metrics::SegmentRules segment_rules(const std::vector<study::ModuleChoice>& families) {
  const auto found = std::ranges::find(families, "segments", &study::ModuleChoice::module);
  return found == families.end() ? metrics::SegmentRules{} : make_params<metrics::SegmentRules>(found->params);
}

}  // namespace scanbench::results
