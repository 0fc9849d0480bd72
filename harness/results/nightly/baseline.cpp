// Writes and reads baselines.
#include "harness/results/nightly/baseline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "core/names.hpp"
#include "core/special_values.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/folder_name.hpp"
#include "harness/io/files/hash.hpp"
#include "harness/io/files/json.hpp"
#include "harness/results/analysis/statistics.hpp"
#include "harness/runs/store/json_file.hpp"

namespace scanbench::results {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using metrics::MetricRow;

constexpr int kBaselineSchema = 2;  ///< 1: right lines on walls too small to judge counted as false

Json number(double value) {
  if (std::isnan(value)) return nullptr;  // JSON has no NaN and no infinities
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return value;
}

double number_of(const Json& json) {
  if (json.is_null()) return kNaN;
  if (json == "inf") return kInf;
  if (json == "-inf") return -kInf;
  return json.get<double>();
}

/// The cells of one pipeline in one scenario, in the order of the run.
struct Group {
  std::string scenario;
  std::string pipeline;
  std::vector<const CellResults*> cells;
};

std::vector<Group> groups_of(const RunResults& results) {
  std::vector<Group> groups;
  for (const auto& cell : results.cells) {
    if (groups.empty() || groups.back().scenario != cell.key.scenario || groups.back().pipeline != cell.key.pipeline) {
      const auto known = std::ranges::find_if(groups, [&](const Group& group) {
        return group.scenario == cell.key.scenario && group.pipeline == cell.key.pipeline;
      });
      if (known != groups.end()) {
        known->cells.push_back(&cell);
        continue;
      }
      groups.push_back({cell.key.scenario, cell.key.pipeline, {}});
    }
    groups.back().cells.push_back(&cell);
  }
  return groups;
}

/// Of the values of all seeds, to find in a moment whether anything has changed.
std::string hash_of(const Group& group) {
  Json values = Json::array();
  for (const auto* cell : group.cells)
    for (const auto& row : cell->rows) values.push_back({cell->key.seed, row.metric, number(row.value)});
  return io::sha256_hex(io::json_line(values));
}

Json metric_json(const Group& group, const MetricRow& example) {
  Json listed = Json::array();
  Json walls = Json::array();
  std::vector<double> values;
  for (const auto* cell : group.cells) {
    const auto row = std::ranges::find(cell->rows, example.metric, &MetricRow::metric);
    values.push_back(row == cell->rows.end() ? kNaN : row->value);
    listed.push_back(number(values.back()));
    walls.push_back(row == cell->rows.end() ? 0 : row->count);
  }
  const MeanInterval mean = mean_interval(values);
  Json json{{"unit", example.unit},
            {"median", number(median(values))},
            {"ci_low", number(mean.low)},
            {"ci_high", number(mean.high)},
            {"values", std::move(listed)}};
  if (example.subject == kMeanOfSubjects) json["walls"] = std::move(walls);
  return json;
}

Json group_json(const Group& group) {
  Json seeds = Json::array();
  Json recordings = Json::array();
  std::map<std::string, const MetricRow*> metrics;
  for (const auto* cell : group.cells) {
    seeds.push_back(cell->key.seed);
    recordings.push_back(cell->recording.substr(0, 16));
    for (const auto& row : cell->rows) metrics.emplace(row.metric, &row);
  }
  Json listed = Json::object();
  for (const auto& [name, row] : metrics) listed[name] = metric_json(group, *row);
  return {{"scenario", group.scenario}, {"pipeline", group.pipeline}, {"hash", hash_of(group)}, {"seeds", seeds},
          {"recordings", recordings},   {"metrics", listed}};
}

void read_group(const Json& json, RunResults& results) {
  const auto seeds = json.at("seeds").get<std::vector<std::uint64_t>>();
  const Json& recordings = json.at("recordings");
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    CellResults cell;
    cell.key = {json.at("scenario"), json.at("pipeline"), seeds[i]};
    cell.status = "ok";
    cell.recording = recordings.at(i);
    for (const auto& [name, metric] : json.at("metrics").items()) {
      MetricRow row;
      row.metric = name;
      const auto walls = metric.find("walls");  // absent for a value of the whole
      row.subject = walls == metric.end() ? "all" : kMeanOfSubjects;
      if (walls != metric.end()) row.count = walls->at(i).get<std::int64_t>();
      row.unit = metric.at("unit");
      row.value = number_of(metric.at("values").at(i));
      cell.rows.push_back(std::move(row));
    }
    results.cells.push_back(std::move(cell));
  }
}

/// One value per metric: of the subject "all", else the mean of those that are defined, with their number.
std::vector<MetricRow> gate_rows(const std::vector<MetricRow>& rows, const Gates& gates) {
  std::map<std::string, std::vector<const MetricRow*>> by_metric;
  for (const auto& row : rows)
    if (gates.is_judged(row.metric)) by_metric[row.metric].push_back(&row);
  std::vector<MetricRow> reduced;
  for (const auto& [metric, subjects] : by_metric) {
    MetricRow row = *subjects.front();
    const auto all = std::ranges::find(subjects, std::string("all"), &MetricRow::subject);
    if (all != subjects.end()) {
      row = **all;
    } else {
      double sum = 0.0;
      double count = 0.0;
      std::int64_t walls = 0;
      for (const auto* subject : subjects) {
        if (!std::isfinite(subject->value)) continue;
        sum += subject->value;
        count += 1.0;
        walls += subject->subject == "mean" ? 0 : 1;
      }
      row.value = count > 0 ? sum / count : kNaN;
      row.count = walls;
      row.subject = kMeanOfSubjects;
    }
    reduced.push_back(std::move(row));
  }
  return reduced;
}

void check_complete(const RunResults& results) {
  for (const auto& cell : results.cells)
    if (!cell.ok())
      throw ConfigError(fmt::format("{}: {} is {}: a baseline must be complete", results.name,
                                    runs::to_string(cell.key), cell.status));
  if (results.cells.empty()) throw ConfigError(results.name + ": it has no cells");
}

/// The number of a baseline's file; 0 for any other file of the folder.
unsigned long baseline_number(const fs::path& file) {
  constexpr std::size_t kMostDigits = 9;
  const std::string stem = file.stem().string();
  const bool is_number =
      !stem.empty() && stem.size() <= kMostDigits && stem.find_first_not_of("0123456789") == std::string::npos;
  return is_number && file.extension() == ".json" ? std::stoul(stem) : 0;
}

}  // namespace

RunResults gate_values(const RunResults& results, const Gates& gates) {
  RunResults reduced = results;
  for (auto& cell : reduced.cells) {
    cell.rows = gate_rows(cell.rows, gates);
    cell.recording = cell.recording.substr(0, 16);
  }
  return reduced;
}

std::vector<fs::path> baseline_files(const fs::path& baselines, const std::string& suite) {
  std::vector<fs::path> files;
  const fs::path folder = baselines / io::check_name("suite", suite);
  std::error_code absent;
  if (!fs::is_directory(folder, absent)) return files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (baseline_number(entry.path()) > 0) files.push_back(entry.path());
  std::ranges::sort(files, {}, [](const fs::path& file) { return std::pair(baseline_number(file), file.string()); });
  return files;
}

std::vector<fs::path> current_baselines(const std::vector<fs::path>& files) {
  std::vector<fs::path> current;
  std::ranges::copy_if(files, std::back_inserter(current), [](const fs::path& file) {
    return runs::load_json_object(file).value("schema", Json()) == kBaselineSchema;
  });
  return current;
}

Baseline load_baseline(const fs::path& file) {
  return runs::with_json_of(file, [&](const Json& json) {
    if (json.value("program", Json()) != "scanbench" || json.value("kind", Json()) != "baseline")
      throw ConfigError(file.string() + ": not a baseline of scanbench");
    if (json.at("schema") == 1)
      throw ConfigError(file.string() +
                        ": schema is 1; allowed: 2. Its precision and F1 count right lines on walls too small to judge "
                        "as false, so they cannot be compared with today's: accept a new run");
    if (json.at("schema") != kBaselineSchema)
      throw ConfigError(fmt::format("{}: schema is {}; allowed: {}", file.string(), io::json_line(json.at("schema")),
                                    kBaselineSchema));
    Baseline baseline{file, json.at("accepted"), json.at("reason"), {}};
    baseline.results.name = "baseline " + file.stem().string();
    baseline.results.provenance.commit = json.at("commit");
    baseline.results.provenance.compiler = json.at("compiler");
    baseline.results.provenance.processor = json.at("processor");
    for (const auto& [scenario, settings] : json.at("settings").items())
      baseline.results.settings[scenario] = settings.get<std::map<std::string, std::string>>();
    for (const auto& group : json.at("groups")) read_group(group, baseline.results);
    return baseline;
  });
}

fs::path accept_baseline(const fs::path& baselines, const std::string& suite, const RunResults& results,
                         const Gates& gates, const std::string& reason) {
  if (reason.find_first_not_of(" \t\n") == std::string::npos)
    throw ConfigError("--reason is empty; allowed: why the baseline moves, for those who read it later");
  check_complete(results);
  if (!results.overrides.empty())
    throw ConfigError(
        fmt::format("the run was made with --set {}, and a baseline is of the suite as its files say; "
                    "change a file, run the night again, and accept that",
                    join(results.overrides)));
  const RunResults reduced = gate_values(results, gates);
  Json groups = Json::array();
  for (const auto& group : groups_of(reduced)) groups.push_back(group_json(group));
  Json settings = Json::object();
  for (const auto& [scenario, values] : reduced.settings) settings[scenario] = values;
  const Json json{{"schema", kBaselineSchema},
                  {"program", "scanbench"},
                  {"kind", "baseline"},
                  {"suite", suite},
                  {"accepted", runs::utc_now()},
                  {"reason", reason},
                  {"commit", reduced.provenance.commit},
                  {"compiler", reduced.provenance.compiler},
                  {"processor", reduced.provenance.processor},
                  {"settings", settings},
                  {"groups", groups}};
  const fs::path folder = baselines / io::check_name("suite", suite);
  while (true) {
    const auto files = baseline_files(baselines, suite);
    if (!files.empty() && runs::load_json_object(files.back()).value("groups", Json()) == groups)
      throw ConfigError(files.back().string() + " has these values already; nothing to accept");
    const fs::path file = folder / fmt::format("{:04}.json", files.empty() ? 1 : baseline_number(files.back()) + 1);
    io::make_folders(folder);
    if (io::write_new_file(file, io::json_text(json, 1) + "\n")) return file;  // else another process took the number
  }
}

}  // namespace scanbench::results
