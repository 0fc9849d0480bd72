// Takes the values of a metric in two cells, subject by subject.
#include "harness/results/analysis/cell_pair.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "harness/results/analysis/run_results.hpp"

namespace scanbench::results {
namespace {

using metrics::MetricRow;

bool same_bits(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

double value_of(const RowsBySubject& rows, const std::string& subject) {
  const auto found = rows.find(subject);
  return found == rows.end() ? kNaN : found->second->value;
}

/// The value of the whole; a baseline's mean over subjects is one too.
double whole_value(const RowsBySubject& rows) {
  return value_of(rows, rows.contains("all") ? "all" : kMeanOfSubjects);
}

std::size_t defined_subjects(const RowsBySubject& rows) {
  return static_cast<std::size_t>(std::ranges::count_if(
      rows, [](const auto& row) { return row.first != "mean" && std::isfinite(row.second->value); }));
}

/// The means over the subjects that are defined in both.
CellPair pair_of_means(const RowsBySubject& a, const RowsBySubject& b) {
  CellPair pair;
  double sum_a = 0.0;
  double sum_b = 0.0;
  double common = 0.0;
  for (const auto& [subject, row] : a) {
    const double before = row->value;
    const double after = value_of(b, subject);
    if (!std::isfinite(before) || !std::isfinite(after)) continue;
    sum_a += before;
    sum_b += after;
    common += 1.0;
    pair.subjects.both += subject == "mean" ? 0U : 1U;
  }
  if (common > 0) {
    pair.before = sum_a / common;
    pair.after = sum_b / common;
  }
  pair.subjects.before = defined_subjects(a);
  pair.subjects.after = defined_subjects(b);
  return pair;
}

}  // namespace

std::map<std::string, RowsBySubject> by_metric(const std::vector<MetricRow>& rows) {
  std::map<std::string, RowsBySubject> grouped;
  for (const auto& row : rows) grouped[row.metric].emplace(row.subject, &row);
  return grouped;
}

CellPair pair_of(const RowsBySubject& a, const RowsBySubject& b) {
  const auto is_whole = [](const RowsBySubject& rows) {
    return rows.contains("all") || rows.contains(kMeanOfSubjects);
  };
  CellPair pair;
  if (is_whole(a) || is_whole(b)) {
    pair.before = whole_value(a);
    pair.after = whole_value(b);
    if (a.contains(kMeanOfSubjects) && b.contains(kMeanOfSubjects)) {
      pair.subjects.before = static_cast<std::size_t>(a.at(kMeanOfSubjects)->count);
      pair.subjects.after = static_cast<std::size_t>(b.at(kMeanOfSubjects)->count);
    }
  } else {
    pair = pair_of_means(a, b);
  }
  // Of a baseline that was accepted before it counted walls, the mean is called "all".
  pair.same =
      a.size() == b.size() && std::ranges::equal(a, b, [&](const auto& x, const auto& y) {
        return (x.first == y.first || (is_whole(a) && is_whole(b))) && same_bits(x.second->value, y.second->value);
      });
  return pair;
}

}  // namespace scanbench::results
