// The values that two cells have of one metric.
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "core/special_values.hpp"
#include "metrics/metric.hpp"

namespace scanbench::results {

/// Of a mean over subjects (walls): how many have a value in the earlier run, in the later one, and in both. All 0 for
/// a value of the whole.
struct SubjectCounts {
  std::size_t before = 0;
  std::size_t after = 0;
  std::size_t both = 0;

  /// How many have no value in one of the runs; against a baseline, which only counts them, at least that many.
  std::size_t uncommon() const { return std::max(before, after) - (both > 0 ? both : std::min(before, after)); }
};

struct CellPair {
  double before = kNaN;
  double after = kNaN;
  bool same = true;  ///< every subject, to the bit
  SubjectCounts subjects{};
};

/// The rows of one metric of a cell, by subject. They point into the rows of the cell.
using RowsBySubject = std::map<std::string, const metrics::MetricRow*>;

std::map<std::string, RowsBySubject> by_metric(const std::vector<metrics::MetricRow>& rows);

/// The values of the subject "all"; without it the means over the subjects that are defined in both.
CellPair pair_of(const RowsBySubject& a, const RowsBySubject& b);

}  // namespace scanbench::results
