// Aligners over many scenarios on one page: who places most scans, and from how far off.
#pragma once

#include <vector>

#include "harness/report/table.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/store/summary.hpp"

namespace scanbench::harness {

/// For runs of at least two scenarios that report the metric `placed` (family alignment): the pipelines by the share of
/// scans that they place, with intervals over seeds and the difference to the next; and the share of seeds in which
/// they place every scan, scenario by scenario in the order of the start error: the basin of convergence. Only seeds
/// that every pipeline finished in every scenario count. No table otherwise.
std::vector<Table> aligner_ranking(const std::vector<Scenario>& scenarios, const std::vector<SummaryRow>& rows);

}  // namespace scanbench::harness
