// scenario.yaml and effective.yaml of a run, or a folder of each, and copies of the files that they name.
#include "harness/store/run_files.hpp"

#include <variant>

#include <nlohmann/json.hpp>

#include "harness/files/atomic_file.hpp"
#include "harness/files/hash.hpp"
#include "harness/scenario/scenario_file.hpp"
#include "harness/store/json_file.hpp"
#include "harness/store/manifest.hpp"

namespace scanbench::harness {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kPublished = "published.csv";
constexpr const char* kLines = "lines.csv";
constexpr const char* kSources = "sources.json";

fs::path inputs_path(const fs::path& run, const std::string& scenario) {
  return run / "inputs" / scenario;
}

Json source_json(const fs::path& file, const std::string& sha256) {
  return {{"file", file.filename().string()}, {"sha256", sha256}};
}

/// Copies a file; returns its entry in sources.json.
Json copy_input(const fs::path& from, const fs::path& to, const std::string& name) {
  const std::string bytes = read_file(from);
  make_folders(to.parent_path());
  write_file_atomically(to, bytes);
  return {{"file", name}, {"sha256", sha256_hex(bytes)}};
}

/// `up` leads from the folder of the effective scenario to the run folder.
StoredInputs store_inputs(const fs::path& run, const Scenario& scenario, const std::string& up) {
  const fs::path folder = inputs_path(run, scenario.name);
  const std::string prefix = up + "inputs/" + scenario.name + "/";
  StoredInputs stored;
  Json sources = Json::object();
  if (!scenario.published_file.empty()) {
    sources["published"] =
        copy_input(scenario.published_file, folder / kPublished, scenario.published_file.filename().string());
    stored.published = prefix + kPublished;
  }
  if (const auto* lines = std::get_if<LinesInput>(&scenario.input); lines != nullptr && !lines->file.empty()) {
    sources["lines"] = copy_input(lines->file, folder / kLines, lines->file_name);
    stored.lines = prefix + kLines;
  }
  if (const auto* recorded = std::get_if<RecordedInput>(&scenario.input))
    sources["log"] = source_json(recorded->log, sha256_of_file(recorded->log));
  if (sources.empty()) return stored;
  make_folders(folder);
  write_file_atomically(folder / kSources, sources.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  return stored;
}

/// What sources.json knows of files that are elsewhere.
void add_sources(const fs::path& run, Scenario& scenario) {
  const fs::path file = inputs_path(run, scenario.name) / kSources;
  if (!fs::exists(file)) return;
  with_json_of(file, [&](const Json& sources) {
    if (auto* lines = std::get_if<LinesInput>(&scenario.input); lines != nullptr && sources.contains("lines"))
      lines->file_name = sources.at("lines").at("file").get<std::string>();
    if (auto* recorded = std::get_if<RecordedInput>(&scenario.input); recorded != nullptr && sources.contains("log"))
      recorded->log_sha256 = sources.at("log").at("sha256").get<std::string>();
  });
}

}  // namespace

void write_run_scenarios(const fs::path& run, const std::vector<Scenario>& scenarios,
                         const EffectiveText& effective_yaml) {
  if (scenarios.size() == 1) {
    const Scenario& scenario = scenarios.front();
    const StoredInputs stored = store_inputs(run, scenario, "");
    write_file_atomically(run / "scenario.yaml", scenario.text);
    write_file_atomically(run / "effective.yaml", effective_yaml(scenario, stored));
    return;
  }
  make_folders(run / "scenarios");
  make_folders(run / "effective");
  for (const auto& scenario : scenarios) {
    const StoredInputs stored = store_inputs(run, scenario, "../");
    write_file_atomically(run / "scenarios" / (scenario.name + ".yaml"), scenario.text);
    write_file_atomically(run / "effective" / (scenario.name + ".yaml"), effective_yaml(scenario, stored));
  }
}

std::vector<Scenario> load_run_scenarios(const fs::path& run) {
  const Manifest manifest = load_manifest(run);
  std::vector<Scenario> scenarios;
  for (const auto& name : manifest.scenarios) {
    const fs::path alone = run / "effective.yaml";
    const bool many = manifest.scenarios.size() > 1 || !fs::exists(alone);
    scenarios.push_back(load_recorded_scenario(many ? run / "effective" / (name + ".yaml") : alone));
    scenarios.back().name = name;
    add_sources(run, scenarios.back());
  }
  return scenarios;
}

}  // namespace scanbench::harness
