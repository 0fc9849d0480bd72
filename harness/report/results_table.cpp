// Grouping, averaging over seeds, marking the best.
#include "harness/report/results_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "core/registry.hpp"
#include "harness/analysis/statistics.hpp"
#include "harness/report/table_marks.hpp"
#include "metrics/metric.hpp"

namespace scanbench::harness {
namespace {

using metrics::Direction;
using metrics::MetricDescription;

// Our value of one (pipeline, metric, subject) over seeds.
using Key = std::pair<std::string, std::string>;  // metric, subject
class Values {
 public:
  explicit Values(const std::vector<SummaryRow>& rows, const std::string& scenario) {
    for (const auto& row : rows)
      if (row.scenario == scenario) values_[row.pipeline][{row.metric, row.subject}].push_back(row.value);
  }
  std::optional<Interval> find(const std::string& pipeline, const Key& key) const {
    const auto p = values_.find(pipeline);
    if (p == values_.end()) return std::nullopt;
    const auto v = p->second.find(key);
    if (v == p->second.end()) return std::nullopt;
    return mean_interval(v->second);
  }

 private:
  std::map<std::string, std::map<Key, std::vector<double>>> values_;
};

std::string value_text(const Interval& interval, const Display& display) {
  if (std::isnan(interval.mean)) return "–";
  std::string text = fmt::format("{:.{}f}", interval.mean * display.scale, display.decimals);
  if (interval.count > 1) text += fmt::format(" ± {:.{}f}", interval.half_width() * display.scale, display.decimals);
  return text;
}

struct Family {
  std::string name;
  std::vector<MetricDescription> metrics;
};

class TableBuilder {
 public:
  TableBuilder(const Scenario& scenario, const std::vector<SummaryRow>& rows)
      : scenario_(scenario), rows_(rows), values_(rows, scenario.name) {}

  std::optional<Table> build(const Family& family) const {
    const auto subjects = subjects_of(family);
    if (!subjects.empty()) return by_subject(family, subjects);
    const bool any = std::ranges::any_of(family.metrics, [&](const auto& m) { return reported(m.metric); });
    return any ? std::optional(by_pipeline(family)) : std::nullopt;
  }

 private:
  /// Other than "all", in the order of their first row.
  std::vector<std::string> subjects_of(const Family& family) const {
    std::set<std::string> names;
    for (const auto& metric : family.metrics) names.insert(metric.metric);
    std::vector<std::string> subjects;
    for (const auto& row : rows_)
      if (row.subject != "all" && row.scenario == scenario_.name && names.contains(row.metric) &&
          std::ranges::find(subjects, row.subject) == subjects.end())
        subjects.push_back(row.subject);
    return subjects;
  }

  double largest(const std::string& metric) const {
    double largest = 0.0;
    for (const auto& row : rows_)
      if (row.scenario == scenario_.name && row.metric == metric && std::isfinite(row.value))
        largest = std::max(largest, std::abs(row.value));
    return largest;
  }

  // Rows: subjects. Columns: per metric, the pipelines.
  Table by_subject(const Family& family, const std::vector<std::string>& subjects) const {
    Table table{family.name, scenario_.name + ": " + family.name, caption(), {"line"}, {}, {}};
    for (const auto& subject : subjects) table.rows.push_back({{subject}, {}, false});
    for (const auto& metric : family.metrics) {
      if (!reported(metric.metric, subjects)) continue;
      const Display display = display_for(metric.unit, largest(metric.metric));
      const std::size_t first = table.columns.size();
      for (const auto& pipeline : scenario_.pipelines)
        table.columns.push_back({heading(metric.metric, display), pipeline.name, false});
      for (std::size_t r = 0; r < subjects.size(); ++r) {
        auto& cells = table.rows[r].cells;
        std::vector<double> ours;
        for (const auto& pipeline : scenario_.pipelines) {
          const auto value = values_.find(pipeline.name, {metric.metric, subjects[r]});
          cells.push_back({value ? value_text(*value, display) : "", false, false});
          ours.push_back(value ? value->mean : std::numeric_limits<double>::quiet_NaN());
        }
        mark_best(pointers(cells, first, ours.size()), ours, metric.direction);
      }
    }
    return table;
  }

  // Rows: pipelines. Columns: metrics.
  Table by_pipeline(const Family& family) const {
    Table table{family.name, scenario_.name + ": " + family.name, caption(), {"pipeline"}, {}, {}};
    struct Column {
      const MetricDescription* metric;
      Display display;
    };
    std::vector<Column> columns;
    for (const auto& metric : family.metrics) {
      if (!reported(metric.metric)) continue;
      columns.push_back({&metric, display_for(metric.unit, largest(metric.metric))});
      table.columns.push_back({"", heading(metric.metric, columns.back().display), false});
    }
    for (const auto& pipeline : scenario_.pipelines) {
      Table::Row row{{pipeline.name}, {}, false};
      for (const auto& column : columns) {
        const Key key{column.metric->metric, "all"};
        const auto value = values_.find(pipeline.name, key);
        row.cells.push_back({value ? value_text(*value, column.display) : "", false, false});
      }
      table.rows.push_back(std::move(row));
    }
    for (std::size_t c = 0; c < columns.size(); ++c) {
      std::vector<TableCell*> cells;
      std::vector<double> ours;
      for (auto& row : table.rows) {
        const auto value = values_.find(row.heads.front(), {columns[c].metric->metric, "all"});
        cells.push_back(&row.cells[c]);
        ours.push_back(value ? value->mean : std::numeric_limits<double>::quiet_NaN());
      }
      mark_best(cells, ours, columns[c].metric->direction);
    }
    return table;
  }

  static std::vector<TableCell*> pointers(std::vector<TableCell>& cells, std::size_t first, std::size_t count) {
    std::vector<TableCell*> result;
    for (std::size_t i = 0; i < count; ++i) result.push_back(&cells[first + i]);
    return result;
  }

  bool reported(const std::string& metric) const {
    return std::ranges::any_of(rows_,
                               [&](const SummaryRow& r) { return r.scenario == scenario_.name && r.metric == metric; });
  }

  // Of any of these subjects: a metric of the whole run has no place among lines.
  bool reported(const std::string& metric, const std::vector<std::string>& subjects) const {
    return std::ranges::any_of(rows_, [&](const SummaryRow& r) {
      return r.scenario == scenario_.name && r.metric == metric && std::ranges::count(subjects, r.subject) > 0;
    });
  }

  std::string caption() const {
    std::string text = "* best of its kind";
    if (scenario_.seeds.size() > 1)
      text += fmt::format("; mean over {} seeds ± half width of the 95 % interval", scenario_.seeds.size());
    return text + ".";
  }

  const Scenario& scenario_;
  const std::vector<SummaryRow>& rows_;
  Values values_;
};

}  // namespace

std::vector<Table> result_tables(const Scenario& scenario, const std::vector<SummaryRow>& rows,
                                 const std::vector<std::string>& shown_elsewhere) {
  const TableBuilder builder(scenario, rows);
  std::vector<Table> tables;
  for (const auto& choice : scenario.metrics) {
    const auto family = Registry<metrics::MetricFamily>::make(choice.module, choice.params);
    auto described = family->describe();
    std::erase_if(described, [&](const auto& m) { return std::ranges::count(shown_elsewhere, m.metric) > 0; });
    if (auto table = builder.build({choice.module, std::move(described)})) tables.push_back(std::move(*table));
  }
  return tables;
}

}  // namespace scanbench::harness
