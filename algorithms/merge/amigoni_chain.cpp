// amigoni_chain: joins segments that a pairwise relation connects, directly or through others, into one line (after F.
// Amigoni and S. Gasparini, "Analysis of methods for reducing line segments in maps: towards a general approach", IROS
// 2008, as described in Lakaemper 2009, section II). Its weakness is that deviations add up along a chain.
//
// Unusable lines (not finite, without length, beyond 1e9 m) are dropped; if none is left, the status is degenerate. The
// map does not depend on the order of the lines or of their ends.
#include "algorithms/merge/parts/line_match.hpp"
#include "core/disjoint_sets.hpp"
#include "core/index.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

class AmigoniChain final : public SegmentMerger {
 public:
  struct Params {
    double max_angle_deg = 10.0;
    double max_distance_m = 0.20;
    double max_gap_m = 0.0;
    static auto fields() { return merge::match_fields<Params>(); }
  };

  explicit AmigoniChain(const Params& p) : rules_(merge::match_tolerance(p)) {}

  MergeResult merge(const MergeInput& input, Trace& trace) const override {
    trace.stage(Stage::match);
    const merge::DistinctLines distinct = merge::distinct_lines(input.lines);
    const auto& lines = distinct.representatives;
    const merge::NearSegments near(lines, rules_);
    DisjointSets chains(lines.size());
    for (std::size_t i = 0; i < lines.size(); ++i)
      near.for_each_after(i, [&](std::size_t j) {
        if (chains.find(i) != chains.find(j) && merge::match_cost(lines[i], lines[j], rules_)) chains.unite(i, j);
      });

    trace.stage(Stage::merge);
    const std::vector<int> chain = chains.labels();
    std::vector<merge::Representative> merged;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto c = as_index(chain[i]);
      if (c == merged.size())
        merged.push_back(lines[i]);
      else
        merged[c] = merge::united(merged[c], lines[i]);
    }
    return merge::result_of(input.lines, distinct, chain, merged);
  }

 private:
  merge::MatchTolerance rules_;
};

SCANBENCH_REGISTER(
    SegmentMerger, AmigoniChain,
    {.name = "amigoni_chain",
     .summary = "merges chains of pairwise matching segments (transitive closure of a simple relation)",
     .reference = "Amigoni & Gasparini, Analysis of methods for reducing line segments in maps, IROS 2008"});

}  // namespace
}  // namespace scanbench
