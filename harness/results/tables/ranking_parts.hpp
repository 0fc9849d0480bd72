// Rankings of methods as parts of a page: a table, and accuracy against time.
#pragma once

#include <string>
#include <vector>

#include "harness/results/analysis/method_ranking.hpp"
#include "harness/results/document/document.hpp"

namespace scanbench::results {

/// "optimal has the best f1 of 9 pipelines in room, 0.98, and beats the next, polyline, with probability 0.9." or why
/// none is called best.
std::string ranking_sentence(const MethodRanking& ranking);

/// "The best for a given time a scan: sef from 8 µs (0.81), iepf from 26 µs (0.93)." Empty if one is best for any time.
std::string budget_sentence(const MethodRanking& ranking);

/// One section per ranking: the scenarios and their condition, the sentences, the table and the chart. Names of
/// scenarios lead to `report` + "#" + name, unless `report` is empty.
Blocks ranking_blocks(const std::vector<MethodRanking>& rankings, const std::string& report);

/// Accuracy against time as inline SVG; empty if no time is known.
std::string accuracy_chart(const MethodRanking& ranking);

}  // namespace scanbench::results
