// scenario.yaml and effective.yaml (or a folder of each), benchmark.json, gates.json, and copies of the input of a run.
#include "harness/runs/store/run_scenarios.hpp"

#include <algorithm>
#include <variant>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/folder_name.hpp"
#include "harness/io/files/hash.hpp"
#include "harness/io/files/json.hpp"
#include "harness/runs/store/json_file.hpp"
#include "harness/runs/store/manifest.hpp"
#include "harness/runs/store/run_file.hpp"
#include "harness/study/scenario/scenario_file.hpp"
#include "harness/study/scenario/wall_table.hpp"

namespace scanbench::runs {
namespace fs = std::filesystem;
namespace {

const RunFile kScenarioFile("scenario.yaml");
const RunFile kEffectiveFile("effective.yaml");
const RunFile kScenarioFiles[] = {RunFile("scenarios/*.yaml"), RunFile("effective/*.yaml")};
const RunFile kBenchmarkFile("benchmark.json");
const RunFile kGatesFile("gates.json");

const RunFile kPublishedCopy("inputs/*/published.csv");
const RunFile kLinesCopy("inputs/*/lines.csv");
const RunFile kWallTable("inputs/*/walls.csv");
const RunFile kSourcesFile("inputs/*/sources.json");

/// A world with more walls is stored as a table: as YAML they would take 10 ms to read for each thousand.
constexpr std::size_t kMostWallsInYaml = 1000;

using Json = nlohmann::ordered_json;

fs::path inputs_path(const fs::path& run, const std::string& scenario) {
  return run / "inputs" / io::check_name("scenario", scenario);
}

Json source_json(const fs::path& file, const std::string& sha256) {
  return {{"file", file.filename().string()}, {"sha256", sha256}};
}

/// Copies a file; returns its entry in sources.json.
Json copy_input(const fs::path& from, const fs::path& to, const std::string& name) {
  const std::string bytes = io::read_file(from);
  io::make_folders(to.parent_path());
  io::write_file_atomically(to, bytes);
  return {{"file", name}, {"sha256", io::sha256_hex(bytes)}};
}

/// The simulated world of a scenario; nullptr if it has none.
const sim::World* world_of(const study::Scenario& scenario) {
  if (const auto* simulated = std::get_if<study::SimulatedInput>(&scenario.input)) return &simulated->world;
  const auto* lines = std::get_if<study::LinesInput>(&scenario.input);
  return lines != nullptr && lines->world ? &*lines->world : nullptr;
}

/// `up` leads from the folder of the effective scenario to the run folder.
study::StoredInputs store_inputs(const fs::path& run, const study::Scenario& scenario, const std::string& up) {
  const fs::path folder = inputs_path(run, scenario.name);
  const std::string prefix = up + "inputs/" + scenario.name + "/";
  study::StoredInputs stored;
  Json sources = Json::object();
  if (!scenario.published_file.empty()) {
    sources["published"] =
        copy_input(scenario.published_file, folder / kPublishedCopy, scenario.published_file.filename().string());
    stored.published = prefix + kPublishedCopy.name();
  }
  if (const auto* lines = std::get_if<study::LinesInput>(&scenario.input); lines != nullptr && !lines->file.empty()) {
    sources["lines"] = copy_input(lines->file, folder / kLinesCopy, lines->file_name);
    stored.lines = prefix + kLinesCopy.name();
  }
  if (const auto* recorded = std::get_if<study::RecordedInput>(&scenario.input)) {
    sources["log"] = source_json(recorded->log, io::sha256_of_file(recorded->log));
    if (!recorded->relations.empty())
      sources["relations"] = source_json(recorded->relations, io::sha256_of_file(recorded->relations));
  }
  if (const sim::World* world = world_of(scenario); world != nullptr && world->walls.size() > kMostWallsInYaml) {
    io::make_folders(folder);
    io::write_file_atomically(folder / kWallTable, study::wall_table(world->walls));
    stored.walls = prefix + kWallTable.name();
  }
  if (sources.empty()) return stored;
  io::make_folders(folder);
  io::write_file_atomically(folder / kSourcesFile, io::json_text(sources) + "\n");
  return stored;
}

/// Adds what sources.json says of files that are elsewhere.
void add_sources(const fs::path& run, study::Scenario& scenario) {
  const fs::path file = inputs_path(run, scenario.name) / kSourcesFile;
  if (!fs::exists(file)) return;
  with_json_of(file, [&](const Json& sources) {
    if (auto* lines = std::get_if<study::LinesInput>(&scenario.input); lines != nullptr && sources.contains("lines"))
      lines->file_name = sources.at("lines").at("file").get<std::string>();
    if (auto* recorded = std::get_if<study::RecordedInput>(&scenario.input); recorded != nullptr) {
      const auto hash_of = [&](const char* key) {
        return sources.contains(key) ? sources.at(key).at("sha256").get<std::string>() : std::string();
      };
      recorded->log_sha256 = hash_of("log");
      recorded->relations_sha256 = hash_of("relations");
    }
  });
}

/// The effective scenario of that name.
fs::path effective_file(const fs::path& run, const std::vector<std::string>& names, const std::string& name) {
  const fs::path alone = run / kEffectiveFile;
  const bool many = names.size() > 1 || !fs::exists(alone);
  return many ? run / "effective" / (io::check_name("scenario", name).text() + ".yaml") : alone;
}

}  // namespace

void write_run_scenarios(const fs::path& run, const std::vector<study::Scenario>& scenarios,
                         const EffectiveText& effective_yaml) {
  if (scenarios.size() == 1) {
    const study::Scenario& scenario = scenarios.front();
    const study::StoredInputs stored = store_inputs(run, scenario, "");
    io::write_file_atomically(run / kScenarioFile, scenario.text);
    io::write_file_atomically(run / kEffectiveFile, effective_yaml(scenario, stored));
    return;
  }
  io::make_folders(run / "scenarios");
  io::make_folders(run / "effective");
  for (const auto& scenario : scenarios) {
    const study::StoredInputs stored = store_inputs(run, scenario, "../");
    io::write_file_atomically(run / "scenarios" / (scenario.name + ".yaml"), scenario.text);
    io::write_file_atomically(run / "effective" / (scenario.name + ".yaml"), effective_yaml(scenario, stored));
  }
}

std::map<std::string, std::map<std::string, std::string>> load_run_settings(const fs::path& run) {
  const Manifest manifest = load_manifest(run);
  std::map<std::string, std::map<std::string, std::string>> settings;
  for (const auto& name : manifest.scenarios) {
    const fs::path file = effective_file(run, manifest.scenarios, name);
    settings[name] = study::effective_settings(io::read_file(file), file.string());
    const fs::path walls = inputs_path(run, name) / kWallTable;
    if (const auto table = settings[name].find("world.segments.file"); table != settings[name].end())
      table->second = "SHA-256 " + io::sha256_of_file(walls).substr(0, 12);
  }
  return settings;
}

std::vector<study::Scenario> load_run_scenarios(const fs::path& run) {
  return load_run_scenarios(run, load_manifest(run).scenarios);
}

std::vector<study::Scenario> load_run_scenarios(const fs::path& run, const std::vector<std::string>& names) {
  std::vector<study::Scenario> scenarios;
  for (const auto& name : names) {
    scenarios.push_back(study::load_recorded_scenario(effective_file(run, names, name)));
    scenarios.back().name = name;
    add_sources(run, scenarios.back());
  }
  return scenarios;
}

std::vector<fs::path> scenario_files(const fs::path& run, const std::vector<std::string>& names) {
  std::vector<fs::path> files{kScenarioFile.name(), kEffectiveFile.name(), kBenchmarkFile.name(), kGatesFile.name()};
  if (names.size() > 1) files = {kBenchmarkFile.name(), kGatesFile.name()};
  for (const auto& name : names) {
    if (names.size() > 1)
      for (const char* folder : {"scenarios", "effective"}) files.push_back(fs::path(folder) / (name + ".yaml"));
    for (const RunFile* file : {&kPublishedCopy, &kLinesCopy, &kWallTable, &kSourcesFile})
      files.push_back(inputs_path("", name) / *file);
  }
  std::erase_if(files, [&](const fs::path& file) { return !fs::exists(run / file); });
  return files;
}

void write_suite_rules(const fs::path& run, const study::SuiteRules& rules) {
  if (rules.benchmark)
    io::write_file_atomically(run / kBenchmarkFile, study::benchmark_json(*rules.benchmark));
  else
    io::remove_file(run / kBenchmarkFile);
  if (!rules.gates.tolerances.empty())
    io::write_file_atomically(run / kGatesFile, study::gates_json(rules.gates));
  else
    io::remove_file(run / kGatesFile);
}

study::GateSpec load_gates(const fs::path& run) {
  const fs::path path = run / kGatesFile;
  if (!fs::exists(path)) return {};
  return with_json_of(path, [&](const Json& json) {
    study::GateSpec spec;
    for (const auto& [metric, tolerance] : json.at("gates").items()) {
      const double value = tolerance.get<double>();
      if (!(value >= 0))
        throw ConfigError(path.string() + ": the tolerance of " + metric + " is negative; allowed: >= 0");
      spec.tolerances[metric] = value;
    }
    return spec;
  });
}

std::optional<study::BenchmarkSpec> load_benchmark(const fs::path& run) {
  const fs::path path = run / kBenchmarkFile;
  if (!fs::exists(path)) return std::nullopt;
  const auto json = load_json_object(path);
  try {
    study::BenchmarkSpec spec{json.at("about"), json.at("baseline"), json.at("example"), json.value("of", "extract")};
    if (json.contains("levels"))
      for (const auto& level : json.at("levels"))
        spec.levels.push_back({level.at("factor"), level.at("level"), level.at("scenarios")});
    if (const auto slots = study::benchmark_slots(); std::ranges::find(slots, spec.of) == slots.end())
      throw ConfigError(path.string() + ": no benchmark ranks modules of the kind " + spec.of);
    return spec;
  } catch (const nlohmann::json::exception& error) {
    refuse_json(path, error);
  }
}

std::optional<study::BenchmarkSpec> load_benchmark(const fs::path& run, const std::vector<study::Scenario>& scenarios) {
  auto spec = load_benchmark(run);
  if (spec)
    if (const std::string fault = study::benchmark_fault(*spec, scenarios); !fault.empty())
      throw ConfigError((run / kBenchmarkFile).string() + " is of another run: " + fault);
  return spec;
}

}  // namespace scanbench::runs
