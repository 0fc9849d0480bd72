// Writes and reads the plan of a sweep: sweep.json, cells.csv, and the scenarios as a run folder has them.
#include "harness/runs/sweep/sweep_plan.hpp"

#include <algorithm>
#include <set>
#include <string_view>
#include <unordered_set>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/csv.hpp"
#include "harness/io/files/folder.hpp"
#include "harness/io/files/hash.hpp"
#include "harness/io/files/json.hpp"
#include "harness/runs/execute/run_plan.hpp"
#include "harness/runs/store/json_file.hpp"
#include "harness/runs/store/manifest.hpp"
#include "harness/runs/store/run_scenarios.hpp"
#include "harness/runs/sweep/shard_commit.hpp"
#include "harness/study/scenario/effective.hpp"

namespace scanbench::runs {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSweepFile = "sweep.json";
constexpr const char* kUnfinishedPlan = ".plan.tmp-unfinished";  // says whose a folder without sweep.json is
constexpr const char* kPlanFile = "cells.csv";
const std::vector<std::string> kPlanColumns{"shard", "address", "scenario", "pipeline", "seed"};

/// Throws ConfigError for a folder that this program may not write a plan into.
void require_sweep_or_nothing(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(folder, error))) return;
  if (!fs::is_directory(folder, error)) throw ConfigError(folder.string() + " is a file; allowed: a folder");
  const auto names = io::names_in(folder);
  const bool is_empty = std::ranges::all_of(names, [](const std::string& name) { return io::is_temporary_name(name); });
  if (is_empty || fs::exists(folder / kUnfinishedPlan)) return;
  if (!fs::exists(folder / kSweepFile))
    throw ConfigError(folder.string() +
                      " is not empty and has no sweep.json, so it is not the folder of a sweep; it stays unchanged");
  const Json json = load_json_object(folder / kSweepFile);
  if (json.value("program", Json()) != "scanbench")
    throw ConfigError((folder / kSweepFile).string() + " is not the plan of a sweep");
}

/// Deals the recordings that have cells to run to the shards, one after the other, so that each shard gets a part of
/// every scenario. Returns the number of shards.
int deal(const RunPlan& plan, const SweepOptions& options, std::vector<SweepCell>& cells) {
  const auto committed = committed_addresses(options.out);
  std::vector<int> shard_of(plan.groups.size(), 0);
  std::vector<bool> is_needed(plan.groups.size(), false);
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (!committed.contains(cells[i].address)) is_needed[plan.cells[i].group] = true;
  const int shards = static_cast<int>(std::min<std::ptrdiff_t>(options.shards, std::ranges::count(is_needed, true)));
  int next = 0;
  for (std::size_t g = 0; g < is_needed.size(); ++g)
    if (is_needed[g]) shard_of[g] = 1 + next++ % shards;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (!committed.contains(cells[i].address)) cells[i].shard = shard_of[plan.cells[i].group];
  return shards;
}

std::string cells_csv(const std::vector<SweepCell>& cells) {
  io::CsvWriter csv(kPlanColumns);
  for (const SweepCell& cell : cells) {
    csv.integer(cell.shard).text(cell.address).text(cell.key.scenario).text(cell.key.pipeline);
    csv.seed(cell.key.seed).end_row();
  }
  return csv.str();
}

std::string seal_of(Json json) {
  json.erase("seal");
  return io::sha256_hex(io::json_line(json));
}

void write_plan(const SweepPlan& plan, const SweepOptions& options) {
  io::write_file_atomically(plan.folder / kPlanFile, cells_csv(plan.cells));
  Json files = Json::array();
  std::vector<fs::path> paths = scenario_files(plan.folder, plan.scenarios);
  paths.emplace_back(kPlanFile);
  for (const auto& path : paths)
    files.push_back({{"path", path.generic_string()}, {"sha256", io::sha256_of_file(plan.folder / path)}});
  Json json{{"schema", 1},
            {"program", "scanbench"},
            {"version", plan.program},
            {"code_version", plan.code},
            {"argv", options.argv},
            {"name", plan.name},
            {"scenarios", plan.scenarios},
            {"cells", plan.cells.size()},
            {"shards", plan.shards},
            {"trace", plan.journal},
            {"files", files}};
  json["seal"] = seal_of(json);
  io::write_file_atomically(plan.folder / kSweepFile, io::json_text(json) + "\n");
}

[[noreturn]] void refuse_changed(const fs::path& file) {
  throw ConfigError(
      file.string() +
      " has been changed since the sweep was planned; `scanbench sweep plan` writes it again, and committed "
      "cells stay");
}

void load_cells(SweepPlan& plan) {
  const fs::path file = plan.folder / kPlanFile;
  const io::CsvTable csv(io::read_file(file), file, kPlanColumns);
  plan.cells.reserve(csv.rows());
  for (std::size_t r = 0; r < csv.rows(); ++r)
    plan.cells.push_back({{csv.folder_name(r, "scenario"), csv.folder_name(r, "pipeline"),
                           static_cast<std::uint64_t>(csv.integer(r, "seed"))},
                          csv.text(r, "address"),
                          csv.index(r, "shard")});
}

}  // namespace

SweepPlan plan_sweep(const std::vector<study::Scenario>& scenarios, const SweepOptions& options) {
  if (options.shards < 1 || options.shards > kMostShards)
    throw ConfigError("shards is " + std::to_string(options.shards) + "; allowed: 1 .. " + std::to_string(kMostShards));
  require_sweep_or_nothing(options.out);
  SweepPlan plan;
  plan.folder = options.out;
  plan.name = options.name;
  plan.journal = options.journal;
  plan.code = code_version();
  plan.program = version_text();
  for (const auto& scenario : scenarios) plan.scenarios.push_back(scenario.name);
  const RunPlan cells = plan_run(scenarios, {.out = options.out, .journal = options.journal});
  plan.cells.reserve(cells.cells.size());
  for (const PlannedCell& cell : cells.cells) plan.cells.push_back({cells.key(cell), cells.address(cell), 0});
  plan.shards = deal(cells, options, plan.cells);
  io::make_folders(options.out);
  // Of a killed plan. Shards may be at work in a folder of their own.
  io::remove_temporaries(options.out, {options.out / "shards", options.out / kUnfinishedPlan});
  if (!fs::exists(options.out / kSweepFile)) io::write_file_atomically(options.out / kUnfinishedPlan, "");
  io::make_folders(options.out / "shards");
  write_suite_rules(options.out, options.rules);
  write_run_scenarios(options.out, scenarios, study::effective_yaml);
  write_plan(plan, options);
  io::remove_file(options.out / kUnfinishedPlan);
  return plan;
}

SweepPlan load_sweep(const fs::path& folder) {
  const fs::path file = folder / kSweepFile;
  std::error_code error;
  if (!fs::exists(file, error))
    throw ConfigError(folder.string() + ": not the folder of a sweep: it has no sweep.json");
  SweepPlan plan;
  plan.folder = folder;
  with_json_of(file, [&](const Json& json) {
    if (json.at("program") != "scanbench") throw ConfigError(file.string() + " is not the plan of a sweep");
    if (json.at("schema") != 1)
      throw ConfigError(file.string() + ": schema is " + io::json_line(json.at("schema")) + "; allowed: 1");
    if (json.at("seal").get<std::string>() != seal_of(json)) refuse_changed(file);
    for (const auto& entry : json.at("files")) {
      const fs::path listed = folder / entry.at("path").get<std::string>();
      if (io::sha256_of_file(listed) != entry.at("sha256").get<std::string>()) refuse_changed(listed);
    }
    plan.name = json.at("name").get<std::string>();
    plan.scenarios = json.at("scenarios").get<std::vector<std::string>>();
    for (const auto& scenario : plan.scenarios) io::check_name("scenario", scenario);
    plan.shards = json.at("shards").get<int>();
    plan.journal = json.at("trace").get<bool>();
    plan.code = json.at("code_version").get<std::string>();
    plan.program = json.at("version").get<std::string>();
  });
  load_cells(plan);
  return plan;
}

void require_this_program(const SweepPlan& plan) {
  if (plan.code == code_version()) return;
  throw ConfigError(plan.folder.string() + " was planned by another program, " + plan.program + "; this is " +
                    version_text() + (plan.program == version_text() ? " with other bytes" : "") +
                    "; run that one, or plan the sweep again");
}

std::vector<study::Scenario> sweep_scenarios(const SweepPlan& plan) {
  auto scenarios = load_run_scenarios(plan.folder, plan.scenarios);
  for (const auto& scenario : scenarios) {
    const auto* recorded = std::get_if<study::RecordedInput>(&scenario.input);
    if (recorded == nullptr) continue;
    for (const auto& [file, hash] :
         {std::pair(recorded->log, recorded->log_sha256), std::pair(recorded->relations, recorded->relations_sha256)})
      if (!file.empty() && io::sha256_of_file(file) != hash)
        throw ConfigError(file.string() + " has other bytes than when the sweep was planned; plan it again");
  }
  return scenarios;
}

}  // namespace scanbench::runs
