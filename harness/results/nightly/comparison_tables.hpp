// The tables of a comparison, for the terminal and for pages.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/results/analysis/comparison.hpp"
#include "harness/results/document/document.hpp"
#include "harness/results/document/table.hpp"

namespace scanbench::results {

/// A row per change: scenario, pipeline, metric; before, after, difference with its interval, tolerance, effect, q,
/// what it is a mean over (seeds, scans of a log; walls, where some have no value in one of the runs), the seed that
/// became worse by most. On a page in the folder `run`, values lead to the folder of their cells, and the seed has the
/// command that shows its worst scan.
Table change_table(const std::string& id, const std::string& title, const std::vector<const MetricChange*>& changes,
                   const std::string& run);

/// Cells that are broken, mended, failing in both runs, missing or new; nullopt if there are none.
std::optional<Table> completeness_table(const Comparison& comparison);

/// What a reader of a comparison needs, in this order: worse, uncertain, better, changed without a direction,
/// completeness. Tables without rows are left out; with `all`, every change is shown.
std::vector<Table> comparison_tables(const Comparison& comparison, bool all = false);

/// The verdict, what differs, and the tables of comparison_tables(): for a terminal or a pull request.
Document comparison_document(const Comparison& comparison, bool all = false);

}  // namespace scanbench::results
