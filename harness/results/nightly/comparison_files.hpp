// A comparison for other programs: JSON, and JUnit XML for a CI server.
#pragma once

#include <string>

#include "harness/results/analysis/comparison.hpp"

namespace scanbench::results {

/// Verdict, sentence, what differs, every change with its pairs, and the cells that are not compared (docs/formats.md).
std::string comparison_json(const Comparison& comparison);

/// One test case per gate and one per cell that is broken or missing. A gate that is worse is a failure, a cell that is
/// missing an error.
std::string comparison_junit(const Comparison& comparison);

}  // namespace scanbench::results
