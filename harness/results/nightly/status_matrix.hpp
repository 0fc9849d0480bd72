// What happened to every pipeline in every scenario, at a glance.
#pragma once

#include <string>
#include <vector>

#include "harness/results/analysis/comparison.hpp"
#include "harness/results/analysis/method_ranking.hpp"
#include "harness/results/analysis/run_results.hpp"
#include "harness/results/document/document.hpp"

namespace scanbench::results {

/// One table per group of scenarios that have the same pipelines, so that none is mostly empty: a row per pipeline, a
/// column per scenario; the cells of a scenario with its own pipelines are side by side. A cell has a symbol, a word, a
/// colour and one value: the change of the metric that moved most in units of its tolerance, else the metric by which
/// the group is ranked. It leads to the scenario in `report`, if that is not empty. Empty if nothing was compared.
Blocks status_matrices(const RunResults& now, const Comparison& comparison, const std::vector<MethodRanking>& rankings,
                       const std::string& report);

}  // namespace scanbench::results
