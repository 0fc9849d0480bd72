// Writes the values of two runs side by side.
#include "harness/results/analysis/value_pairs.hpp"

#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include "core/special_values.hpp"
#include "harness/io/files/csv.hpp"

namespace scanbench::results {
namespace {

using metrics::Direction;
using metrics::MetricDescription;
using metrics::MetricRow;

/// An infinite value is not a result: in either direction it is not better than any other.
std::string_view judge(const MetricDescription& description, double a, double b) {
  if (description.timing) return "timing";
  if (a == b || (std::isnan(a) && std::isnan(b))) return "same";
  if (!std::isfinite(a) && !std::isfinite(b)) return "changed";
  if (!std::isfinite(b)) return "worse";
  if (!std::isfinite(a)) return "better";
  if (std::fabs(b - a) <= description.tolerance) return "within";
  if (metrics::better(description, b, a)) return "better";
  return metrics::better(description, a, b) ? "worse" : "changed";
}

std::string_view name_of(Direction direction) {
  switch (direction) {
    case Direction::lower_is_better:
      return "lower_is_better";
    case Direction::higher_is_better:
      return "higher_is_better";
    case Direction::target:
      return "target";
    case Direction::neither:
      break;
  }
  return "neither";
}

class PairWriter {
 public:
  explicit PairWriter(const Gates& gates) : gates_(gates) {}

  void add_cells(const runs::CellKey& key, const CellResults* a, const CellResults* b) {
    if (a != nullptr && b != nullptr && a->ok() && b->ok()) {
      add_rows(key, a->rows, b->rows);
      return;
    }
    const std::string before = a != nullptr ? a->status : "missing";
    const std::string after = b != nullptr ? b->status : "missing";
    if (before == "missing" && after == "missing") return;
    const std::string_view verdict = after == "missing"    ? "only_in_a"
                                     : before == "missing" ? "only_in_b"
                                     : before == "ok"      ? "worse"
                                     : after == "ok"       ? "better"
                                                           : "not_judged";
    MetricRow status;
    status.metric = "status";
    status.subject = before + " -> " + after;
    write(key, status, kNaN, kNaN, verdict);
  }

  std::string csv() const { return csv_.str(); }

 private:
  void add_rows(const runs::CellKey& key, const std::vector<MetricRow>& a, const std::vector<MetricRow>& b) {
    std::map<std::pair<std::string, std::string>, const MetricRow*> rows_b;
    for (const auto& row : b) rows_b.emplace(std::pair{row.metric, row.subject}, &row);
    for (const auto& row : a) {
      const auto found = rows_b.find({row.metric, row.subject});
      if (found == rows_b.end()) {
        write(key, row, row.value, kNaN, "only_in_a");
        continue;
      }
      const double after = found->second->value;
      write(key, row, row.value, after, judge(gates_.description(row.metric), row.value, after));
      rows_b.erase(found);
    }
    for (const auto& row : b)
      if (rows_b.contains({row.metric, row.subject})) write(key, row, kNaN, row.value, "only_in_b");
  }

  void write(const runs::CellKey& key, const MetricRow& row, double a, double b, std::string_view verdict) {
    const MetricDescription& description = gates_.description(row.metric);
    csv_.text(key.scenario).text(key.pipeline).seed(key.seed).text(row.metric).text(row.subject);
    csv_.number(a).number(b).number(verdict == "same" ? 0.0 : b - a);  // two undefined values have no difference
    csv_.text(row.unit).text(name_of(description.direction)).number(description.tolerance);
    csv_.text(std::string(verdict)).end_row();
  }

  const Gates& gates_;
  io::CsvWriter csv_{{"scenario", "pipeline", "seed", "metric", "subject", "a", "b", "difference", "unit", "direction",
                      "tolerance", "verdict"}};
};

}  // namespace

std::string value_pairs_csv(const RunResults& a, const RunResults& b, const Gates& gates) {
  std::map<runs::CellKey, const CellResults*> of_b;
  for (const auto& cell : b.cells) of_b.emplace(cell.key, &cell);
  PairWriter writer(gates);
  for (const auto& cell : a.cells) {
    const auto found = of_b.find(cell.key);
    writer.add_cells(cell.key, &cell, found == of_b.end() ? nullptr : found->second);
    if (found != of_b.end()) of_b.erase(found);
  }
  for (const auto& cell : b.cells)
    if (of_b.contains(cell.key)) writer.add_cells(cell.key, nullptr, &cell);
  return writer.csv();
}

}  // namespace scanbench::results
