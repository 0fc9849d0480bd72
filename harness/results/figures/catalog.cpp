// Collects the entries of all registries, sensors and formats of logs.
#include "harness/results/figures/catalog.hpp"

#include <algorithm>
#include <cctype>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/modules.hpp"
#include "core/names.hpp"
#include "harness/io/files/json.hpp"
#include "harness/results/analysis/gates.hpp"
#include "harness/results/document/table.hpp"
#include "harness/study/scenario/sections.hpp"
#include "metrics/metric.hpp"
#include "render/figure.hpp"
#include "sim/sensors.hpp"
#include "sim/trajectory.hpp"

namespace scanbench::results {
namespace {

template <class Interface>
void append(std::vector<CatalogEntry>& entries) {
  for (const auto& [name, entry] : Registry<Interface>::all())
    entries.push_back({std::string(Interface::kKind), entry.info, entry.params, {}});
}

void append_metrics(std::vector<CatalogEntry>& entries) {
  for (const auto& [name, entry] : Registry<metrics::MetricFamily>::all()) {
    CatalogEntry described{std::string(metrics::MetricFamily::kKind), entry.info, entry.params, {}};
    for (const auto& metric : entry.make({})->describe())
      described.notes.push_back(metric.metric + (metric.unit.empty() ? "" : " [" + metric.unit + "]") + ": " +
                                metric.doc);
    entries.push_back(std::move(described));
  }
}

std::string direction_text(const metrics::MetricDescription& metric) {
  switch (metric.direction) {
    case metrics::Direction::lower_is_better:
      return "lower is better";
    case metrics::Direction::higher_is_better:
      return "higher is better";
    case metrics::Direction::target:
      return fmt::format("best near {:g}", metric.target);
    case metrics::Direction::neither:
      break;
  }
  return "no value is better than another";
}

/// What a comparison of two runs does with it.
std::string gate_text(const metrics::MetricDescription& metric) {
  if (metric.timing) return "gate: only if a suite says so, because it depends on the machine";
  if (metric.direction == metrics::Direction::neither) return "gate: no, compare and night run only show changes";
  if (!is_headline(metric.metric))
    return fmt::format("gate: only if a suite says so; compare and night run show a change of more than {:g}",
                       metric.tolerance);
  return fmt::format(
      "gate: compare and night run fail if it is worse by more than {:g}, unless a suite has other gates",
      metric.tolerance);
}

/// An entry for every metric of every family.
std::vector<CatalogEntry> single_metrics() {
  std::vector<CatalogEntry> entries;
  for (const auto& [family, entry] : Registry<metrics::MetricFamily>::all())
    for (const auto& metric : entry.make({})->describe()) {
      CatalogEntry described{"metric", {metric.metric, metric.doc, ""}, {}, {}};
      described.notes.push_back("family: " + family);
      if (!metric.unit.empty()) described.notes.push_back("unit: " + metric.unit);
      described.notes.push_back("direction: " + direction_text(metric));
      described.notes.push_back(gate_text(metric));
      entries.push_back(std::move(described));
    }
  return entries;
}

/// "metric", "metrics" and "Metrics" are one kind.
std::string singular(std::string kind) {
  for (char& c : kind) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (kind.ends_with("ies")) return kind.substr(0, kind.size() - 3) + "y";
  return kind.ends_with('s') ? kind.substr(0, kind.size() - 1) : kind;
}

void append_sensors(std::vector<CatalogEntry>& entries) {
  for (const auto& [name, preset] : sim::sensor_presets()) {
    CatalogEntry described{"sensor", {preset.name, preset.summary, preset.source}, sim::sensor_param_specs(), {}};
    for (auto& spec : described.params)
      if (const auto value = preset.params.find(spec.name); value != preset.params.end())
        spec.default_value = value->second;
    entries.push_back(std::move(described));
  }
}

std::string allowed(const ParamSpec& spec) {
  if (!spec.choices.empty()) {
    std::string text;
    for (const auto& choice : spec.choices) text += (text.empty() ? "" : ", ") + choice;
    return text;
  }
  const std::string bounds = spec.bounds.describe();
  return std::string(to_string(spec.type)) + (bounds.empty() ? "" : " " + bounds);
}

/// "required" instead of a default that is unused.
std::string default_text(const CatalogEntry& entry, const ParamSpec& spec) {
  const bool is_required = std::ranges::count(entry.required, spec.name) > 0;
  return is_required ? "required" : to_text(spec.default_value);
}

Table param_table(const CatalogEntry& entry) {
  Table table{entry.info.name, "parameters", "", {"parameter", "default", "unit", "allowed", "meaning"}, {}, {}};
  for (const auto& spec : entry.params)
    table.rows.push_back({{spec.name, default_text(entry, spec), spec.unit, allowed(spec), spec.doc}, {}, false});
  return table;
}

}  // namespace

std::vector<CatalogEntry> catalog() {
  std::vector<CatalogEntry> entries;
  append<LineExtractor>(entries);
  append<Aligner>(entries);
  append<ScanMatcher>(entries);
  append<Mapper>(entries);
  append<SegmentMerger>(entries);
  append_metrics(entries);
  append<render::Figure>(entries);
  append<sim::TrajectoryKind>(entries);
  append_sensors(entries);
  for (auto& format : study::recording_formats())
    entries.push_back({"recording", std::move(format.info), std::move(format.params), std::move(format.notes),
                       std::move(format.required)});
  return entries;
}

std::vector<CatalogEntry> find_in_catalog(const std::string& name) {
  std::vector<CatalogEntry> found;
  std::vector<std::string> known;
  for (auto& entry : catalog()) {
    known.push_back(entry.info.name);
    if (std::ranges::find(known, entry.kind) == known.end()) known.push_back(entry.kind);
    if (entry.info.name == name || entry.kind + "/" + entry.info.name == name || entry.kind == name)
      found.push_back(std::move(entry));
  }
  for (auto& metric : single_metrics()) {
    known.push_back(metric.info.name);
    if (metric.info.name == name || metric.kind + "/" + metric.info.name == name) found.push_back(std::move(metric));
  }
  if (found.empty()) {
    const std::string near = nearest_name(name, known);
    throw ConfigError("nothing is called '" + name + "'" + (near.empty() ? "" : "; did you mean '" + near + "'?") +
                      " (`scanbench list` shows all names)");
  }
  return found;
}

std::vector<CatalogEntry> catalog_of_kind(const std::string& kind) {
  static const std::set<std::string> kModules{"extract", "align", "match", "map", "merge"};
  const std::string wanted = singular(kind);
  std::vector<CatalogEntry> found;
  std::vector<std::string> kinds{"modules"};
  for (auto& entry : catalog()) {
    if (std::ranges::count(kinds, entry.kind) == 0) kinds.push_back(entry.kind);
    if (kind.empty() || singular(entry.kind) == wanted || (wanted == "module" && kModules.contains(entry.kind)))
      found.push_back(std::move(entry));
  }
  if (found.empty()) throw ConfigError("there is no kind '" + kind + "'" + known_names(kind, kinds));
  return found;
}

std::string describe_text(const CatalogEntry& entry) {
  std::string out = entry.info.name + " (" + entry.kind + ")\n" + entry.info.summary + "\n";
  if (!entry.info.reference.empty()) out += "Source: " + entry.info.reference + "\n";
  for (const auto& note : entry.notes) out += "  " + note + "\n";
  if (!entry.params.empty()) out += "\n" + to_terminal(param_table(entry), false);
  return out;
}

std::string catalog_text(const std::vector<CatalogEntry>& entries) {
  std::size_t width = 0;
  for (const auto& entry : entries) width = std::max(width, entry.info.name.size());
  std::string out;
  std::string kind;
  for (const auto& entry : entries) {
    if (entry.kind != kind) out += (kind.empty() ? "" : "\n") + entry.kind + "\n";
    kind = entry.kind;
    out += fmt::format("  {:<{}}  {}\n", entry.info.name, width, entry.info.summary);
  }
  return out;
}

std::string catalog_markdown(const std::vector<CatalogEntry>& entries) {
  std::string out = "# Modules\n\nWritten by `scanbench describe --all --format markdown`.\n";
  std::string kind;
  for (const auto& entry : entries) {
    if (entry.kind != kind) out += "\n## " + entry.kind + "\n";
    kind = entry.kind;
    out += "\n### `" + entry.info.name + "`\n\n" + entry.info.summary + "\n";
    if (!entry.info.reference.empty()) out += "\nSource: " + entry.info.reference + "\n";
    for (const auto& note : entry.notes) out += (&note == &entry.notes.front() ? "\n- " : "- ") + note + "\n";
    if (entry.params.empty()) continue;
    out += "\n| parameter | default | unit | allowed | meaning |\n|---|---|---|---|---|\n";
    for (const auto& spec : entry.params)
      out += fmt::format("| `{}` | {} | {} | {} | {} |\n", spec.name, default_text(entry, spec), spec.unit,
                         allowed(spec), spec.doc);
  }
  return out;
}

std::string catalog_json(const std::vector<CatalogEntry>& entries) {
  auto list = nlohmann::ordered_json::array();
  for (const auto& entry : entries) {
    auto params = nlohmann::ordered_json::array();
    for (const auto& spec : entry.params)
      params.push_back({{"name", spec.name},
                        {"default", default_text(entry, spec)},
                        {"unit", spec.unit},
                        {"type", to_string(spec.type)},
                        {"allowed", allowed(spec)},
                        {"doc", spec.doc}});
    list.push_back({{"kind", entry.kind},
                    {"name", entry.info.name},
                    {"summary", entry.info.summary},
                    {"reference", entry.info.reference},
                    {"notes", entry.notes},
                    {"params", params}});
  }
  return io::json_text(list) + "\n";
}

}  // namespace scanbench::results
