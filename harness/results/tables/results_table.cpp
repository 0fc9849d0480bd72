// Makes tables of metric families: means over seeds, notes on missing cells, and marks of the best.
#include "harness/results/tables/results_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/registry.hpp"
#include "core/special_values.hpp"
#include "harness/results/analysis/statistics.hpp"
#include "harness/results/tables/table_marks.hpp"
#include "metrics/metric.hpp"

namespace scanbench::results {
namespace {

using metrics::Direction;
using metrics::MetricDescription;

/// Errors and costs of a pipeline are compared only if its completeness is at most this much worse than the best.
constexpr double kCompletenessMargin = 0.05;
constexpr double kMarginRounding = 1e-9;  ///< a difference of exactly the margin is within it
/// Metrics of completeness: shares of the truth that a pipeline finds or misses; earlier ones are preferred.
constexpr std::array<std::string_view, 4> kCompleteness{"f1", "covered_5cm", "placed", "missed"};

/// The metrics of the overview, in this order: the quality of lines, maps and poses, then what they cost.
constexpr std::array<std::string_view, 17> kOverview{"f1",           "covered_5cm",    "lines_per_wall",
                                                     "placed",       "position_error", "pose_efficiency",
                                                     "rpe_position", "rpe_heading",    "relations_position",
                                                     "ate_position", "missed",         "n_lines",
                                                     "s_mean",       "d_mean",         "t_total",
                                                     "t_scan",       "t_match"};

/// A sentence names at most so many pipelines that share the best value.
constexpr std::size_t kMostNamed = 3;

/// What describes a pipeline but does not judge it alone: one line per point has no distances, and the fastest may find
/// nothing.
bool judges_nothing(std::string_view metric) {
  constexpr std::array<std::string_view, 5> kDescribing{"s_mean", "d_mean", "d_max", "d_mean_pts", "d_max_scan"};
  return metric.starts_with("t_") || std::ranges::count(kDescribing, metric) > 0;
}

using Key = std::pair<std::string, std::string>;  // metric, subject

/// Our values of one (pipeline, metric, subject) over seeds.
class Values {
 public:
  explicit Values(const std::vector<runs::SummaryRow>& rows) {
    for (const auto& row : rows) values_[row.pipeline][{row.metric, row.subject}].push_back(row.value);
  }
  const std::vector<double>& of(const std::string& pipeline, const Key& key) const {
    static const std::vector<double> kNone;
    const auto p = values_.find(pipeline);
    if (p == values_.end()) return kNone;
    const auto v = p->second.find(key);
    return v == p->second.end() ? kNone : v->second;
  }

 private:
  std::map<std::string, std::map<Key, std::vector<double>>> values_;
};

struct Family {
  std::string name;
  std::vector<MetricDescription> metrics;
};

class TableBuilder {
 public:
  TableBuilder(const study::Scenario& scenario, const ComparableRows& results,
               std::vector<MetricDescription> all_metrics)
      : scenario_(scenario), results_(results), all_metrics_(std::move(all_metrics)), values_(results.rows) {}

  /// A row per pipeline, also for metrics of single walls.
  std::optional<Table> overview(const Family& family) {
    gate_ = completeness_of(all_metrics_);
    gate_passed_ = within_margin();
    return by_pipeline(family);
  }

  std::optional<Table> build(const Family& family) {
    gate_ = completeness_of(family.metrics);
    if (gate_ == nullptr) gate_ = completeness_of(all_metrics_);
    gate_passed_ = within_margin();
    const auto subjects = subjects_of(family);
    if (!subjects.empty()) return by_subject(family, subjects);
    const bool any = std::ranges::any_of(family.metrics, [&](const auto& m) { return reported(m.metric); });
    return any ? std::optional(by_pipeline(family)) : std::nullopt;
  }

 private:
  /// A value of a table, before it becomes text.
  struct Value {
    std::vector<double> seeds;
    TableCell cell;
    bool complete = false;  ///< every cell of the pipeline is ok and gives a value
  };

  const MetricDescription* completeness_of(const std::vector<MetricDescription>& metrics) const {
    for (const std::string_view name : kCompleteness)
      for (const auto& metric : metrics)
        if (metric.metric == name && reported(metric.metric)) return &metric;
    return nullptr;
  }

  /// For each pipeline whether its completeness is within the margin of the best.
  std::vector<bool> within_margin() const {
    std::vector<bool> passed(results_.pipelines.size(), true);
    if (gate_ == nullptr) return passed;
    std::vector<double> costs;
    for (const auto& pipeline : results_.pipelines) {
      const auto& all = values_.of(pipeline, {gate_->metric, "all"});
      costs.push_back(
          metrics::cost(*gate_, mean_interval(all.empty() ? values_.of(pipeline, {gate_->metric, "mean"}) : all).mean));
    }
    double best = kNaN;
    for (std::size_t i = 0; i < costs.size(); ++i)
      if (results_.coverage.at(results_.pipelines[i]).complete() && (std::isnan(best) || costs[i] < best))
        best = costs[i];
    for (std::size_t i = 0; i < costs.size(); ++i)
      passed[i] = std::isnan(best) || costs[i] <= best + kCompletenessMargin + kMarginRounding;
    return passed;
  }

  Value value_of(const std::string& pipeline, const Key& key, const Display& display, ValueRange range) const {
    const std::vector<double>& seeds = values_.of(pipeline, key);
    const Coverage& coverage = results_.coverage.at(pipeline);
    Value value;
    if (seeds.empty()) {
      value.cell.text = coverage.ok == 0 ? coverage.status() : "";
      return value;
    }
    value.seeds = seeds;
    value.cell.text = seeds_text(seeds, range, display);
    const auto defined =
        static_cast<std::size_t>(std::ranges::count_if(seeds, [](double v) { return std::isfinite(v); }));
    if (defined > 0 && defined < seeds.size()) value.cell.text += fmt::format(" ({} of {})", defined, seeds.size());
    value.complete = coverage.complete() && defined == seeds.size();
    return value;
  }

  /// Errors, costs and deviations from a target are marked only for pipelines of comparable completeness, and nothing
  /// for those that find nothing of the subject.
  void mark(const std::vector<TableCell*>& cells, const std::vector<Value>& values, const MetricDescription& metric,
            const std::string& subject) {
    if (unjudged(metric)) return;
    std::vector<std::vector<double>> seeds;
    std::vector<bool> eligible;
    for (std::size_t i = 0; i < values.size(); ++i) {
      seeds.push_back(values[i].seeds);
      eligible.push_back(values[i].complete && finds(results_.pipelines[i], subject) &&
                         (!gated(metric) || gate_passed_[i]));
    }
    mark_best(cells, seeds, metric, eligible);
  }

  /// False if a pipeline finds no line of the truth, or misses the subject in most scans.
  bool finds(const std::string& pipeline, const std::string& subject) const {
    if (gate_ == nullptr) return true;
    const double value = mean_interval(values_.of(pipeline, {gate_->metric, subject})).mean;
    return !(gate_->direction == Direction::higher_is_better ? value <= 0.0 : value > kMostMissed);
  }

  /// One unit for all values of a metric, which its head states: that of most of them, so that a single bad pipeline
  /// does not turn millimetres into 0.00270 m.
  Display display_of(const MetricDescription& metric) const {
    std::vector<double> sizes;
    double largest = 0.0;
    bool whole = true;
    for (const auto& row : results_.rows) {
      if (row.metric != metric.metric || !std::isfinite(row.value)) continue;
      sizes.push_back(std::fabs(row.value));
      largest = std::max(largest, sizes.back());
      whole = whole && row.value == std::floor(row.value);
    }
    Display display = display_for(metric.unit, sizes.empty() ? 0.0 : median(sizes));
    if (whole && scenario_.seeds.size() == 1 && display.scale == 1.0 && largest >= 1.0)
      display.decimals = 0;  // a count
    return display;
  }

  /// Subjects other than "all", in the order of their first row.
  std::vector<std::string> subjects_of(const Family& family) const {
    std::set<std::string> names;
    for (const auto& metric : family.metrics) names.insert(metric.metric);
    std::vector<std::string> subjects;
    for (const auto& row : results_.rows)
      if (row.subject != "all" && names.contains(row.metric) && std::ranges::count(subjects, row.subject) == 0)
        subjects.push_back(row.subject);
    return subjects;
  }

  std::string note(const std::string& pipeline) const { return results_.coverage.at(pipeline).text(); }

  std::string label(const std::string& pipeline) const {
    return note(pipeline).empty() ? pipeline : pipeline + " (" + note(pipeline) + ")";
  }

  // Rows: subjects. Columns: per metric, the pipelines.
  Table by_subject(const Family& family, const std::vector<std::string>& subjects) {
    Table table{family.name, scenario_.name + ": " + family.name, caption(family), {"line"}, {}, {}};
    for (const auto& subject : subjects) table.rows.push_back({{subject}, {}, false});
    for (const auto& metric : family.metrics) {
      if (!reported(metric.metric, subjects)) continue;
      const Display display = display_of(metric);
      const std::size_t first = table.columns.size();
      for (const auto& pipeline : results_.pipelines)
        table.columns.push_back(column_below(metric, display, label(pipeline)));
      for (std::size_t r = 0; r < subjects.size(); ++r) {
        auto& cells = table.rows[r].cells;
        std::vector<Value> values;
        for (const auto& pipeline : results_.pipelines) {
          values.push_back(value_of(pipeline, {metric.metric, subjects[r]}, display, range_of(metric)));
          cells.push_back(values.back().cell);
        }
        std::vector<TableCell*> added;
        for (std::size_t c = first; c < cells.size(); ++c) added.push_back(&cells[c]);
        mark(added, values, metric, subjects[r]);
      }
    }
    return table;
  }

  // Rows: pipelines. Columns: metrics.
  Table by_pipeline(const Family& family) {
    Table table{family.name, scenario_.name + ": " + family.name, caption(family), {"pipeline"}, {}, {}};
    for (const auto& pipeline : results_.pipelines) table.rows.push_back({{pipeline}, {}, false, note(pipeline)});
    for (const auto& metric : family.metrics) {
      if (!reported(metric.metric)) continue;
      const Display display = display_of(metric);
      table.columns.push_back(metric_column(metric, display));
      std::vector<Value> values;
      const std::string subject = reported(metric.metric, {"all"}) ? "all" : "mean";  // of all walls
      for (std::size_t r = 0; r < table.rows.size(); ++r) {
        values.push_back(value_of(results_.pipelines[r], {metric.metric, subject}, display, range_of(metric)));
        table.rows[r].cells.push_back(values.back().cell);
      }
      std::vector<TableCell*> added;
      for (auto& row : table.rows) added.push_back(&row.cells.back());
      mark(added, values, metric, reported(gate_ == nullptr ? metric.metric : gate_->metric, {"all"}) ? "all" : "mean");
    }
    return table;
  }

  bool reported(const std::string& metric) const {
    return std::ranges::any_of(results_.rows, [&](const runs::SummaryRow& r) { return r.metric == metric; });
  }

  // True for a metric of any of these subjects; a metric of the whole run does not belong in a table of lines.
  bool reported(const std::string& metric, const std::vector<std::string>& subjects) const {
    return std::ranges::any_of(results_.rows, [&](const runs::SummaryRow& r) {
      return r.metric == metric && std::ranges::count(subjects, r.subject) > 0;
    });
  }

  /// True if the mark of the metric depends on the completeness of pipelines.
  bool gated(const MetricDescription& metric) const {
    const bool is_completeness = std::ranges::count(kCompleteness, std::string_view(metric.metric)) > 0;
    return gate_ != nullptr && !is_completeness && metric.direction != Direction::higher_is_better &&
           metric.direction != Direction::neither;
  }

  /// True for times and distances if nothing shows which pipeline finds the right lines.
  bool unjudged(const MetricDescription& metric) const { return gate_ == nullptr && judges_nothing(metric.metric); }

  std::string caption(const Family& family) const {
    std::vector<std::string> parts;
    if (results_.pipelines.size() > 1) explain_marks(family, parts);
    if (scenario_.seeds.size() > 1)
      parts.push_back(fmt::format(
          "mean over {} seeds {}", scenario_.seeds.size(),
          scenario_.seeds.size() < kFewestForInterval ? "(smallest to largest value)" : "with the 95 % interval"));
    parts.insert(parts.end(), results_.notes.begin(), results_.notes.end());
    for (const auto& note : results_.line_notes)
      if (std::ranges::any_of(family.metrics,
                              [&](const auto& m) { return std::ranges::count(note.metrics, m.metric) > 0; }))
        parts.push_back(note.text);
    return parts.empty() ? "" : fmt::format("{}.", fmt::join(parts, "; "));
  }

  void explain_marks(const Family& family, std::vector<std::string>& parts) const {
    const auto any = [&](const auto& holds) {
      return std::ranges::any_of(family.metrics, [&](const auto& m) { return reported(m.metric) && holds(m); });
    };
    const auto has_best = [&](const auto& m) { return m.direction != Direction::neither; };
    if (!any([&](const auto& m) { return has_best(m) && !unjudged(m); })) {
      parts.emplace_back("no value is marked as the best: they do not show which pipeline is right");
      return;
    }
    parts.emplace_back("* marks the best value");
    if (scenario_.seeds.size() > 1) parts.back() += " and those that the seeds do not separate from it";
    if (any([&](const auto& m) { return has_best(m) && unjudged(m); }))
      parts.back() += "; times and distances from lines have no mark, because they do not show which pipeline is right";
    if (gate_ != nullptr) parts.back() += "; of pipelines that find what is judged";
    if (std::ranges::any_of(family.metrics, [&](const auto& m) { return gated(m) && reported(m.metric); }))
      parts.back() += fmt::format("; of errors and costs among pipelines within {} of the best {}", kCompletenessMargin,
                                  words_of(*gate_));
    if (gate_ != nullptr) parts.back() += "; values of the others are grey";
    const bool incomplete =
        std::ranges::any_of(results_.coverage, [](const auto& of_pipeline) { return !of_pipeline.second.complete(); });
    if (incomplete) parts.emplace_back("a pipeline with cells that are not ok has no mark");
  }

  const study::Scenario& scenario_;
  const ComparableRows& results_;
  std::vector<MetricDescription> all_metrics_;
  Values values_;
  const MetricDescription* gate_ = nullptr;  ///< the metric of completeness of the current table; may be null
  std::vector<bool> gate_passed_;            ///< for each pipeline
};

}  // namespace

namespace {

std::vector<Family> families_of(const study::Scenario& scenario) {
  std::vector<Family> families;
  for (const auto& choice : scenario.metrics)
    families.push_back(
        {choice.module, Registry<metrics::MetricFamily>::make(choice.module, choice.params)->describe()});
  return families;
}

std::vector<MetricDescription> metrics_of(const std::vector<Family>& families) {
  std::vector<MetricDescription> all;
  for (const auto& family : families) all.insert(all.end(), family.metrics.begin(), family.metrics.end());
  return all;
}

}  // namespace

std::vector<Table> result_tables(const study::Scenario& scenario, const ComparableRows& results,
                                 const std::vector<std::string>& shown_elsewhere) {
  std::vector<Family> families = families_of(scenario);
  TableBuilder builder(scenario, results, metrics_of(families));
  std::vector<Table> tables;
  for (auto& family : families) {
    std::erase_if(family.metrics, [&](const auto& m) { return std::ranges::count(shown_elsewhere, m.metric) > 0; });
    if (auto table = builder.build(family)) tables.push_back(std::move(*table));
  }
  return tables;
}

std::optional<Table> overview_table(const study::Scenario& scenario, const ComparableRows& results) {
  const std::vector<MetricDescription> all = metrics_of(families_of(scenario));
  Family shown{"overview", {}};
  for (const std::string_view name : kOverview) {
    const auto metric = std::ranges::find(all, name, &MetricDescription::metric);
    const bool has_rows = std::ranges::any_of(results.rows, [&](const runs::SummaryRow& row) {
      return row.metric == name && (row.subject == "all" || row.subject == "mean");
    });
    if (metric != all.end() && has_rows) shown.metrics.push_back(*metric);
  }
  if (shown.metrics.empty()) return std::nullopt;
  auto table = TableBuilder(scenario, results, all).overview(shown);
  table->title = scenario.name + " at a glance";
  return table;
}

namespace {

/// The rows among `rows` that are the best of a column; empty for a column that judges nothing.
std::vector<const Table::Row*> best_of(const Table& table, std::size_t column,
                                       const std::vector<const Table::Row*>& rows) {
  std::vector<const Table::Row*> best;
  if (judges_nothing(table.columns[column].metric)) return best;
  for (const Table::Row* row : rows)
    if (row->cells[column].best) best.push_back(row);
  return best;
}

std::vector<const Table::Row*> rows_of(const Table& table) {
  std::vector<const Table::Row*> rows;
  for (const auto& row : table.rows) rows.push_back(&row);
  return rows;
}

/// The first column with a best value that judges; the number of columns if there is none.
std::size_t deciding_column(const Table& table) {
  const auto rows = rows_of(table);
  std::size_t c = 0;
  while (c < table.columns.size() && best_of(table, c, rows).empty()) ++c;
  return c;
}

/// A value without its interval or range: "0.80" of "0.80 ± 0.03".
std::string mean_of(const std::string& text) {
  return text.substr(0, text.find(' '));
}

/// "a (0.98), b (0.98)"
std::string named(const std::vector<const Table::Row*>& rows, std::size_t column) {
  std::vector<std::string> names;
  names.reserve(rows.size());
  for (const Table::Row* row : rows)
    names.push_back(fmt::format("{} ({})", row->heads.front(), mean_of(row->cells[column].text)));
  return fmt::format("{}", fmt::join(names, ", "));
}

/// The words of a metric in a sentence, without what is better: "RPE, position [cm]".
std::string sentence_words(const TableColumn& column) {
  for (const std::string_view better : {" ↑", " ↓", " ≈"})
    if (const std::size_t at = column.words.find(better); at != std::string::npos) return column.words.substr(0, at);
  return column.words;
}

/// "; best relations error, position [m]: b (1.21)" if headings, or the independent measurements of a log, prefer other
/// pipelines than positions do.
std::string other_best(const Table& table, std::size_t column, const std::vector<const Table::Row*>& best,
                       const std::vector<const Table::Row*>& rows) {
  std::string text;
  for (std::size_t c = column + 1; c < table.columns.size(); ++c) {
    const std::string& metric = table.columns[c].metric;
    if (metric != "rpe_heading" && metric != "relations_position") continue;
    const auto others = best_of(table, c, rows);
    if (!others.empty() && others != best)
      text += fmt::format("; best {}: {}", sentence_words(table.columns[c]), named(others, c));
  }
  return text;
}

/// "mine found: segments per scan 12.3; total time 0.05 ms.": the values of the only pipeline.
std::string found_by(const Table::Row& row, const Table& table) {
  std::vector<std::string> values;
  for (std::size_t c = 0; c < row.cells.size(); ++c) {
    if (row.cells[c].text.empty()) continue;
    // A unit in the head belongs to the value here.
    std::string words = sentence_words(table.columns[c]), unit;
    if (const std::size_t at = words.find(" ["); at != std::string::npos) {
      unit = " " + words.substr(at + 2, words.size() - at - 3);
      words.erase(at);
    }
    values.push_back(fmt::format("{} {}{}", words, row.cells[c].text, unit));
  }
  const std::string note = row.note.empty() ? "" : " (" + row.note + ")";
  return values.empty() ? "" : fmt::format("{}{} found: {}.", row.heads.front(), note, fmt::join(values, "; "));
}

}  // namespace

std::string overview_sentence(const Table& overview) {
  if (overview.rows.empty()) return "";
  if (overview.rows.size() == 1) return found_by(overview.rows.front(), overview);
  const std::vector<const Table::Row*> rows = rows_of(overview);
  const std::size_t c = deciding_column(overview);
  const auto best = c < overview.columns.size() ? best_of(overview, c, rows) : std::vector<const Table::Row*>();
  if (best.empty()) {
    const bool any_judges =
        std::ranges::any_of(overview.columns, [](const auto& column) { return !judges_nothing(column.metric); });
    return any_judges
               ? "No pipeline is called best: none of these values has a best one that every pipeline is eligible for."
               : "No pipeline is called best: neither the distances of points from their lines nor the number of lines "
                 "nor times show which one is right. The metric segments would, where there is a truth to compare "
                 "with.";
  }
  if (best.size() <= kMostNamed)
    return fmt::format("Best {} of {} pipelines: {}{}.", sentence_words(overview.columns[c]), overview.rows.size(),
                       named(best, c), other_best(overview, c, best, rows));
  const auto value_shared = [](const std::vector<const Table::Row*>& of_rows, std::size_t column) {
    const std::string value = mean_of(of_rows.front()->cells[column].text);
    const auto reads_so = [&](const auto* row) { return mean_of(row->cells[column].text) == value; };
    const bool one = std::ranges::all_of(of_rows, reads_so);
    return one ? ", " + value : "";
  };
  std::string text = fmt::format("{} of {} pipelines share the best {}{}", best.size(), overview.rows.size(),
                                 sentence_words(overview.columns[c]), value_shared(best, c));
  for (std::size_t next = c + 1; next < overview.columns.size(); ++next) {
    const auto also = best_of(overview, next, best);
    if (also.empty()) continue;
    const std::string metric = sentence_words(overview.columns[next]);
    return text + (also.size() <= kMostNamed ? fmt::format("; of these, best {}: {}.", metric, named(also, next))
                                             : fmt::format("; {} of these share the best {}{}.", also.size(), metric,
                                                           value_shared(also, next)));
  }
  return text + ".";
}

std::vector<std::string> best_pipelines(const Table& overview) {
  std::vector<std::string> names;
  const std::size_t c = deciding_column(overview);
  if (c == overview.columns.size()) return names;
  for (const Table::Row* row : best_of(overview, c, rows_of(overview))) names.push_back(row->heads.front());
  return names;
}

std::string odometry_sentence(const ComparableRows& results) {
  constexpr std::size_t kMostListed = 6;
  const Values values(results.rows);
  std::vector<std::string> worse;
  double odometry = kNaN;
  std::size_t compared = 0, without = 0;
  for (const auto& pipeline : results.pipelines) {
    const double error = mean_interval(values.of(pipeline, {"rpe_position", "all"})).mean;
    const double of_odometry = mean_interval(values.of(pipeline, {"rpe_odometry_position", "all"})).mean;
    if (!std::isfinite(error) || !std::isfinite(of_odometry)) {
      ++without;
      continue;
    }
    if (error == of_odometry) continue;
    ++compared;
    odometry = of_odometry;
    if (error > of_odometry) worse.push_back(fmt::format("{} ({:.3g} cm)", pipeline, 100 * error));
  }
  if (compared == 0) return "";
  const std::string beside = fmt::format("the odometry (RPE, position: {:.3g} cm)", 100 * odometry);
  if (worse.empty() && without > 0)
    return fmt::format("{} of {} pipelines err less between consecutive scans than {}; {} without a value.", compared,
                       compared + without, beside, without);
  if (worse.empty()) return fmt::format("Every pipeline errs less between consecutive scans than {}.", beside);
  const std::size_t listed = std::min(worse.size(), kMostListed);
  const std::string more = worse.size() > listed ? fmt::format(" and {} more", worse.size() - listed) : "";
  worse.resize(listed);
  return fmt::format("No better between consecutive scans than {}: {}{}.", beside, fmt::join(worse, ", "), more);
}

}  // namespace scanbench::results
