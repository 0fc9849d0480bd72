// A comparison in words.
#pragma once

#include <string>

#include "harness/results/analysis/comparison.hpp"

namespace scanbench::results {

/// "PASS", "FAIL", "INCOMPLETE" or "NOT COMPARED"; a comparison that fails and is incomplete is a FAIL.
std::string verdict_word(const Comparison& comparison);

/// The verdict and its reason in one or two sentences, with the worst change: "FAIL: 2 of 36 gates are worse. The worst
/// is ...".
std::string verdict_sentence(const Comparison& comparison);

/// "f1 of iepf in abcdef fell from 0.931 to 0.9: by 0.031 (95 % interval 0.028 to 0.034; tolerance 0.005)".
std::string change_sentence(const MetricChange& change);

/// How far a change is beyond what is tolerated, in units of the tolerance. A lost value is beyond all measure.
double severity(const MetricChange& change);

/// What the interval of a change comes from: "20 seeds", "910 scans in blocks of 7, 3 without a value now".
std::string sample_text(const MetricChange& change);

/// The changes that a reader asks for first, largest in terms of their tolerance first: those with this finding.
std::vector<const MetricChange*> changes_with(const Comparison& comparison, Finding finding, bool gates_only = true);

}  // namespace scanbench::results
