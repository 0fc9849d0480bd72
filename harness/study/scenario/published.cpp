// Reads published values and compares them with what the scenario computes.
#include "harness/study/scenario/published.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "core/error.hpp"
#include "core/names.hpp"
#include "core/registry.hpp"
#include "harness/io/files/csv.hpp"
#include "harness/io/files/text_file.hpp"
#include "metrics/metric.hpp"

namespace scanbench::study {
namespace {

/// Units of all metrics: those of the scenario's families, and those of the other families with default parameters.
std::map<std::string, std::string> metric_units(const Scenario& scenario) {
  using Families = Registry<metrics::MetricFamily>;
  std::map<std::string, std::string> units;
  const auto add = [&](const metrics::MetricFamily& family) {
    for (const auto& metric : family.describe()) units.emplace(metric.metric, metric.unit);
  };
  for (const auto& choice : scenario.metrics) add(*Families::make(choice.module, choice.params));
  for (const auto& [name, entry] : Families::all()) add(*entry.make({}));
  return units;
}

}  // namespace

std::vector<PublishedValue> load_published(const std::filesystem::path& path) {
  const io::CsvTable csv(io::read_text_file(path, kMaxPublishedBytes), path,
                         {"metric", "subject", "method", "value", "unit"});
  const bool tables = csv.has("table");
  std::vector<PublishedValue> values;
  std::map<std::tuple<std::string, std::string, std::string>, int> lines;
  for (std::size_t r = 0; r < csv.rows(); ++r) {
    const std::string unit = csv.text(r, "unit");
    const bool rating = unit == "rating";
    const double per_unit = unit == "cm" ? 100.0 : 1.0;  // divisor: 100 is exact, a factor of 0.01 is not
    values.push_back({.metric = csv.text(r, "metric"),
                      .subject = csv.text(r, "subject"),
                      .method = csv.text(r, "method"),
                      .value = rating ? std::numeric_limits<double>::quiet_NaN() : csv.number(r, "value") / per_unit,
                      .printed = csv.text(r, "value"),
                      .unit = rating ? "" : unit,
                      .table = tables ? csv.text(r, "table") : "",
                      .line = csv.line(r)});
    const PublishedValue& value = values.back();
    if (value.printed.empty()) csv.refuse(r, "value is empty; allowed: a number; remove rows without a value");
    const auto [first, is_new] = lines.try_emplace({value.metric, value.subject, value.method}, value.line);
    if (!is_new)
      csv.refuse(r, fmt::format("a second value for {}, {}, {}; the first is in line {}", value.metric, value.subject,
                                value.method, first->second));
  }
  if (values.empty()) throw ConfigError(path.string() + ": no values; allowed: at least one row");
  return values;
}

void check_published(const Scenario& scenario) {
  if (scenario.published_file.empty()) return;
  const auto values = load_published(scenario.published_file);
  const auto units = metric_units(scenario);
  std::set<std::string> methods;
  for (const auto& value : values) {
    const auto refuse = [&](const std::string& message) {
      throw ConfigError(fmt::format("{}:{}: {}", scenario.published_file.string(), value.line, message));
    };
    methods.insert(value.method);
    if (std::isnan(value.value)) continue;  // a rating, which no metric computes
    const auto metric = units.find(value.metric);
    if (metric == units.end()) {
      std::vector<std::string> known;
      known.reserve(units.size());
      for (const auto& [name, unit] : units) known.push_back(name);
      refuse("no metric is called " + io::quoted_excerpt(value.metric) + known_names(value.metric, known));
    }
    const bool is_cm = value.unit == "cm" && metric->second == "m";
    if (!is_cm && value.unit != metric->second)
      refuse(fmt::format("unit is {}; allowed for {}: '{}'{}, or rating", io::quoted_excerpt(value.unit), value.metric,
                         metric->second, metric->second == "m" ? ", 'cm'" : ""));
  }
  for (const auto& pipeline : scenario.pipelines)
    if (!pipeline.published.empty() && !methods.contains(pipeline.published))
      throw ConfigError(fmt::format("{}: pipeline {} reproduces {}, which is not a method of {}{}",
                                    scenario.path.string(), pipeline.name, io::quoted_excerpt(pipeline.published),
                                    scenario.published_file.string(),
                                    known_names(pipeline.published, {methods.begin(), methods.end()})));
}

MethodName split_method(const std::string& method) {
  const std::size_t blank = method.rfind(' ');
  if (blank == std::string::npos || method.find('=', blank) == std::string::npos) return {method, ""};
  return {method.substr(0, blank), method.substr(blank + 1)};
}

}  // namespace scanbench::study
