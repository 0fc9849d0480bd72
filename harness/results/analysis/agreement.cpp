// Compares our values with a paper's: orderings of methods, best methods, correlations.
#include "harness/results/analysis/agreement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "core/registry.hpp"
#include "harness/results/analysis/statistics.hpp"
#include "harness/study/scenario/published.hpp"

namespace scanbench::results {
namespace {

using metrics::Direction;
using metrics::MetricDescription;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::map<std::string, MetricDescription> descriptions(const study::Scenario& scenario) {
  std::map<std::string, MetricDescription> known;
  for (const auto& choice : scenario.metrics)
    for (const auto& metric : Registry<metrics::MetricFamily>::make(choice.module, choice.params)->describe())
      known.emplace(metric.metric, metric);
  return known;
}

template <class T>
void add_new(std::vector<T>& list, const T& value) {
  if (std::ranges::find(list, value) == list.end()) list.push_back(value);
}

std::vector<ComparedMethod> methods_of(const study::Scenario& scenario,
                                       const std::vector<study::PublishedValue>& published) {
  std::vector<ComparedMethod> methods;
  for (const auto& pipeline : scenario.pipelines) methods.push_back({pipeline.name, pipeline.published});
  if (std::ranges::any_of(methods, [](const ComparedMethod& m) { return !m.published.empty(); })) return methods;
  std::vector<std::string> names;
  for (const auto& value : published) add_new(names, value.method);
  for (const auto& name : names) methods.push_back({"", name});
  return methods;
}

/// Values of a scenario's summary by pipeline, metric and subject.
class OurValues {
 public:
  OurValues(const study::Scenario& scenario, const std::vector<runs::SummaryRow>& rows) : seeds_(scenario.seeds) {
    for (const auto& row : rows)
      if (row.scenario == scenario.name) values_[{row.pipeline, row.metric, row.subject}][row.seed] = row.value;
  }
  std::vector<double> of(const std::string& pipeline, const std::string& metric, const std::string& subject) const {
    std::vector<double> result(seeds_.size(), kNaN);
    const auto found = values_.find({pipeline, metric, subject});
    if (found == values_.end()) return result;
    for (std::size_t s = 0; s < seeds_.size(); ++s)
      if (const auto value = found->second.find(seeds_[s]); value != found->second.end()) result[s] = value->second;
    return result;
  }

 private:
  const std::vector<std::uint64_t>& seeds_;
  std::map<std::tuple<std::string, std::string, std::string>, std::map<std::uint64_t, double>> values_;
};

/// The paper's subjects, and our other subjects if the paper prints single ones.
std::vector<std::string> subjects_of(const std::string& metric, const std::vector<study::PublishedValue>& published,
                                     const study::Scenario& scenario, const std::vector<runs::SummaryRow>& rows) {
  std::vector<std::string> subjects;
  std::set<std::string> seen;
  const auto add = [&](const std::string& subject) {
    if (seen.insert(subject).second) subjects.push_back(subject);
  };
  for (const auto& value : published)
    if (value.metric == metric) add(value.subject);
  if (subjects == std::vector<std::string>{"all"}) return subjects;
  for (const auto& row : rows)
    if (row.scenario == scenario.name && row.metric == metric && row.subject != "all") add(row.subject);
  return subjects;
}

/// Indices of the best finite values: no other value is better.
std::vector<std::size_t> best_of(const std::vector<double>& values, const MetricDescription& metric) {
  double best = kNaN;
  for (const double value : values)
    if (std::isfinite(value) && metrics::better(metric, value, best)) best = value;
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isfinite(values[i]) && !std::isnan(best) && !metrics::better(metric, best, values[i]))
      indices.push_back(i);
  return indices;
}

}  // namespace

bool ComparedColumn::printed(std::size_t subject) const {
  for (std::size_t m = 0; m < methods.size(); ++m)
    if (!std::isnan(at(subject, m).paper)) return true;
  return false;
}

std::size_t ComparedColumn::printed_subjects() const {
  std::size_t count = 0;
  for (std::size_t s = 0; s < subjects.size(); ++s) count += printed(s) ? 1 : 0;
  return count;
}

double ComparedCell::our_median() const {
  return median(ours);
}

std::vector<ComparedColumn> compare_with_paper(const study::Scenario& scenario,
                                               const std::vector<runs::SummaryRow>& rows) {
  if (scenario.published_file.empty()) return {};
  const auto published = study::load_published(scenario.published_file);
  const auto known = descriptions(scenario);
  const auto methods = methods_of(scenario, published);
  const OurValues ours(scenario, rows);
  std::vector<std::string> names;
  std::map<std::tuple<std::string, std::string, std::string>, const study::PublishedValue*> printed;
  for (const auto& value : published) {
    add_new(names, value.metric);
    printed[{value.metric, value.subject, value.method}] = &value;
  }

  std::vector<ComparedColumn> columns;
  for (const auto& name : names) {
    ComparedColumn column;
    const auto metric = known.find(name);
    if (metric != known.end()) column.metric = metric->second;
    column.metric.metric = name;
    column.seeds = scenario.seeds.size();
    column.methods = methods;
    column.subjects = subjects_of(name, published, scenario, rows);
    for (const auto& subject : column.subjects)
      for (const auto& method : methods) {
        ComparedCell cell{kNaN, "", ours.of(method.pipeline, name, subject)};
        if (const auto found = printed.find({name, subject, method.published}); found != printed.end()) {
          const study::PublishedValue& value = *found->second;
          cell.paper = value.value;
          cell.printed = value.printed;
          column.printed_unit = value.unit;
          column.table = value.table;
        }
        column.cells.push_back(std::move(cell));
      }
    columns.push_back(std::move(column));
  }
  return columns;
}

std::vector<Ordering> orderings(const ComparedColumn& column) {
  std::vector<Ordering> result;
  for (std::size_t s = 0; s < column.subjects.size(); ++s)
    for (std::size_t a = 0; a < column.methods.size(); ++a)
      for (std::size_t b = a + 1; b < column.methods.size(); ++b) {
        const double paper_a = column.at(s, a).paper;
        const double paper_b = column.at(s, b).paper;
        if (!(paper_a < paper_b) && !(paper_b < paper_a)) continue;
        const study::MethodName name_a = study::split_method(column.methods[a].published);
        const study::MethodName name_b = study::split_method(column.methods[b].published);
        if (name_a.family != name_b.family && name_a.setting != name_b.setting) continue;
        Ordering ordering{s, a, b};
        if (paper_b < paper_a) std::swap(ordering.lower, ordering.upper);
        const ComparedCell& lower = column.at(s, ordering.lower);
        const ComparedCell& upper = column.at(s, ordering.upper);
        ordering.holds = lower.our_median() < upper.our_median();
        for (std::size_t k = 0; k < column.seeds; ++k) ordering.seeds_holding += ordering.holds_for(column, k) ? 1 : 0;
        result.push_back(ordering);
      }
  return result;
}

std::vector<double> orderings_per_seed(const ComparedColumn& column) {
  std::vector<double> held(column.seeds, 0.0);
  for (const auto& ordering : orderings(column))
    for (std::size_t k = 0; k < column.seeds; ++k) held[k] += ordering.holds_for(column, k) ? 1 : 0;
  return held;
}

std::vector<BestCount> best_counts(const ComparedColumn& column, Ties ties) {
  std::vector<BestCount> counts;
  if (column.metric.direction == Direction::neither) return counts;
  for (std::size_t m = 0; m < column.methods.size(); ++m)
    if (!column.methods[m].published.empty()) counts.push_back({m, 0, 0, std::vector<double>(column.seeds, 0.0)});

  const auto winners = [&](std::size_t subject, auto&& value_of) {
    std::vector<double> values;
    values.reserve(counts.size());
    for (const auto& count : counts) values.push_back(value_of(column.at(subject, count.method)));
    auto best = best_of(values, column.metric);
    if (ties == Ties::nobodys && best.size() > 1) best.clear();
    return best;
  };
  for (std::size_t s = 0; s < column.subjects.size(); ++s) {
    if (!column.printed(s)) continue;
    for (const auto i : winners(s, [](const ComparedCell& c) { return c.paper; })) ++counts[i].paper;
    for (const auto i : winners(s, [](const ComparedCell& c) { return c.our_median(); })) ++counts[i].median;
    for (std::size_t k = 0; k < column.seeds; ++k)
      for (const auto i : winners(s, [&](const ComparedCell& c) { return c.ours[k]; })) ++counts[i].per_seed[k];
  }
  return counts;
}

Correlation correlation(const ComparedColumn& column) {
  const auto with = [&](auto&& value_of) {
    std::vector<double> paper, ours;
    for (const auto& cell : column.cells) {
      if (!std::isfinite(cell.paper) || !std::isfinite(value_of(cell))) continue;
      paper.push_back(cell.paper);
      ours.push_back(value_of(cell));
    }
    return std::pair{paper.size(), pearson_correlation(paper, ours)};
  };
  Correlation result;
  std::tie(result.cells, result.of_medians) = with([](const ComparedCell& c) { return c.our_median(); });
  for (std::size_t k = 0; k < column.seeds; ++k)
    result.per_seed.push_back(with([&](const ComparedCell& c) { return c.ours[k]; }).second);
  return result;
}

}  // namespace scanbench::results
