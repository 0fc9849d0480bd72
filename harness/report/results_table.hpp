// From the rows of summary.csv to the tables of a report.
#pragma once

#include <string>
#include <vector>

#include "harness/report/table.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/store/summary.hpp"

namespace scanbench::harness {

/// One table per metric family of the scenario, without the metrics that are `shown_elsewhere`. Families that speak of
/// many subjects (walls) have a row per subject and a column per pipeline; the others a row per pipeline and a column
/// per metric. Over several seeds a value is the mean with the half width of its 95 % interval. The best is marked.
std::vector<Table> result_tables(const Scenario& scenario, const std::vector<SummaryRow>& rows,
                                 const std::vector<std::string>& shown_elsewhere = {});

}  // namespace scanbench::harness
