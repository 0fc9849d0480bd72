// Every value of two runs side by side, for programs that want to judge for themselves.
#pragma once

#include <string>

#include "harness/results/analysis/gates.hpp"
#include "harness/results/analysis/run_results.hpp"

namespace scanbench::results {

/// A table with the columns scenario,pipeline,seed,metric,subject,a,b,difference,unit,direction,tolerance,verdict: the
/// rows of `a` in their order, then those that only `b` has. The verdict is that of the value alone: same (to the bit),
/// within (the tolerance), better, worse, changed (no direction), timing (never judged), only_in_a, only_in_b. A cell
/// that is not ok in both runs has one row with the metric "status" and the subject "ok -> crashed".
std::string value_pairs_csv(const RunResults& a, const RunResults& b, const Gates& gates);

}  // namespace scanbench::results
