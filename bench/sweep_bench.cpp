// Sweeps of many cells: the time to plan one, to merge its shards, and to plan it again with one more seed.
//
// A cell and its recording (2 scans of 181 beams, 13 files) are made once and committed under every seed, in 100
// shards. Counters: peak memory of the process, which makes the shards in a child.
#include <benchmark/benchmark.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "harness/io/files/atomic_file.hpp"
#include "harness/runs/sweep/shard.hpp"
#include "harness/runs/sweep/shard_commit.hpp"
#include "harness/runs/sweep/sweep_merge.hpp"
#include "harness/runs/sweep/sweep_plan.hpp"
#include "harness/study/scenario/scenario_file.hpp"

namespace {

using namespace scanbench;
using runs::SweepPlan;
namespace fs = std::filesystem;

std::vector<study::Scenario> room(std::int64_t seeds) {
  return {study::parse_scenario("schema: 1\nseeds: {first: 1, count: " + std::to_string(seeds) + R"(}
name: room
world: {segments: [[a, 0, 0, 10, 0], [b, 10, 0, 10, 8], [c, 10, 8, 0, 8], [d, 0, 8, 0, 0]]}
sensor: {preset: sick_lms200}
trajectory: {kind: waypoints, points_m: {A: [2, 2], B: [7, 5]}, scans: 2}
pipelines: [{name: iepf, extract: {module: iepf, params: {threshold_m: 0.10}}}]
metrics: [segments]
)",
                                "room.yaml")};
}

fs::path folder(const std::string& name) {
  return fs::temp_directory_path() / "scanbench_sweep_bench" / name;
}

SweepPlan planned(const fs::path& out, std::int64_t seeds) {
  return runs::plan_sweep(room(seeds), {.out = out, .name = "room"});
}

/// The lines of a summary of seed 1 as those of another seed.
std::string lines_of(const std::string& summary, std::uint64_t seed) {
  const std::string first = "room,iepf,1,";
  std::istringstream text(summary);
  std::string lines;
  for (std::string line; std::getline(text, line);)
    if (line.starts_with(first)) lines += "room,iepf," + std::to_string(seed) + "," + line.substr(first.size()) + "\n";
  return lines;
}

/// Commits every shard with the files of one cell.
void commit_all(const SweepPlan& plan) {
  fs::remove_all(folder("one"));
  const SweepPlan one = planned(folder("one"), 1);
  runs::run_shard(one.folder, {.shard = 1});
  const runs::ShardCommit commit = runs::load_commits(one.folder).whole.at(0);
  const runs::ArchiveReader reader(commit.archive());
  const auto cell = reader.files(commit.table.cells[0].part, "cells/room/iepf/1");
  const auto recording = reader.files(commit.table.recordings[0].part, "recordings/room/1");
  const std::string summary = io::read_file(commit.folder / "summary.csv");
  for (int shard = 1; shard <= plan.shards; ++shard) {
    runs::CommitWriter writer(plan.folder, shard);
    std::vector<runs::ArchivedCell> cells;
    std::string lines = summary.substr(0, summary.find('\n') + 1);
    for (const auto& planned_cell : plan.cells) {
      if (planned_cell.shard != shard) continue;
      const auto& key = planned_cell.key;
      writer.add_recording(key.scenario, key.seed, recording);
      cells.push_back(writer.add_cell(key, {commit.table.cells[0].record.outcome, planned_cell.address}, cell));
      const std::string of_cell = lines_of(summary, key.seed);
      cells.back().summary_size = of_cell.size();
      lines += of_cell;
    }
    writer.commit(cells, lines);
  }
}

/// A sweep whose cells are all committed; it is made once.
fs::path committed_sweep(std::int64_t cells) {
  const fs::path sweep = folder("sweep" + std::to_string(cells));
  if (fs::exists(sweep)) return sweep;
  if (const pid_t child = ::fork(); child == 0) {
    commit_all(planned(sweep, cells));
    ::_exit(0);
  } else {
    ::waitpid(child, nullptr, 0);
  }
  return sweep;
}

void report_memory(benchmark::State& state) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["peak_MiB"] = static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void sweep_planned(benchmark::State& state) {
  for (auto _ : state) {
    fs::remove_all(folder("planned"));
    benchmark::DoNotOptimize(planned(folder("planned"), state.range(0)));
  }
  report_memory(state);
}

void sweep_merged(benchmark::State& state) {
  const fs::path sweep = committed_sweep(state.range(0));
  for (auto _ : state) {
    state.PauseTiming();
    fs::remove_all(folder("merged"));
    state.ResumeTiming();
    const auto result = runs::merge_sweep(runs::load_sweep(sweep), {.out = folder("merged")});
    if (result.missing) state.SkipWithError("the sweep is not complete; remove its folder");
  }
  report_memory(state);
}

void sweep_planned_with_one_more_seed(benchmark::State& state) {
  const fs::path sweep = committed_sweep(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(planned(sweep, state.range(0) + 1));
  report_memory(state);
  planned(sweep, state.range(0));
}

constexpr std::int64_t kMost = 99999;  // a scenario may have one seed more
BENCHMARK(sweep_planned)->Arg(kMost / 10)->Arg(kMost)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1);
BENCHMARK(sweep_merged)->Arg(kMost / 10)->Arg(kMost)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1);
BENCHMARK(sweep_planned_with_one_more_seed)
    ->Arg(kMost / 10)
    ->Arg(kMost)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(1);

}  // namespace
