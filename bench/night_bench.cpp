// Nights of many cells: the time to add one to the store, to read it back and to compare two of them.
//
// Each night has 10 pipelines on 100 scenarios and cells / 1000 seeds per pipeline and scenario; a cell has the rows of
// one run of `segments`. The second night differs from the first by a change in one pipeline and by rounding in
// another. Counters: peak memory of the process.
#include <benchmark/benchmark.h>

#include <sys/resource.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/results/analysis/comparison.hpp"
#include "harness/results/analysis/verdict.hpp"
#include "harness/results/nightly/store.hpp"

namespace {

using namespace scanbench;
using results::CellResults;
using results::RunResults;

const char* const kMetrics[] = {"f1",         "precision",   "recall",   "overlap", "sigma_offset", "sigma_angle",
                                "true_lines", "false_lines", "n_missed", "n_split", "n_merged",     "t_extract"};

/// A value in [0, 1) that depends on the three numbers alone.
double value_of(std::uint64_t seed, std::uint64_t pipeline, std::uint64_t metric) {
  std::uint64_t bits = seed * 0x9E3779B97F4A7C15u + pipeline * 0xBF58476D1CE4E5B9u + metric * 0x94D049BB133111EBu;
  bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9u;
  bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBu;
  return static_cast<double>((bits ^ (bits >> 31)) >> 11) * 0x1.0p-53;
}

RunResults night(std::int64_t cells, bool changed) {
  constexpr std::uint64_t kScenarios = 100;
  constexpr std::uint64_t kPipelines = 10;
  const std::uint64_t seeds = static_cast<std::uint64_t>(cells) / (kScenarios * kPipelines);
  RunResults results;
  results.name = changed ? "tonight" : "last night";
  results.provenance.start = changed ? "2026-03-02T02:30:00Z" : "2026-03-01T02:30:00Z";
  results.cells.reserve(static_cast<std::size_t>(cells));
  for (std::uint64_t s = 0; s < kScenarios; ++s)
    for (std::uint64_t p = 0; p < kPipelines; ++p)
      for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        CellResults cell;
        cell.key = {"scenario" + std::to_string(s), "pipeline" + std::to_string(p), seed};
        cell.status = "ok";
        cell.recording = "0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef";
        std::uint64_t m = 0;
        for (const char* metric : kMetrics) {
          double value = value_of(seed + 1000 * s, p, ++m);
          if (changed && p == 3) value += 0.01 * value_of(seed, p, m + 100);
          if (changed && p == 4) value *= 1 + 1e-15;
          cell.rows.push_back({.metric = metric,
                               .subject = "all",
                               .value = value,
                               .unit = "",
                               .count = 100,
                               .ci_low = {},
                               .ci_high = {}});
        }
        results.cells.push_back(std::move(cell));
      }
  return results;
}

void report_memory(benchmark::State& state) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["peak_MiB"] = static_cast<double>(usage.ru_maxrss) / 1024.0;
}

std::filesystem::path empty_store() {
  const auto file = std::filesystem::temp_directory_path() / "scanbench_night_bench.sqlite";
  for (const char* end : {"", "-wal", "-shm"}) std::filesystem::remove(file.string() + end);
  return file;
}

void night_stored(benchmark::State& state) {
  const RunResults results = night(state.range(0), false);
  for (auto _ : state) {
    results::Store store(empty_store());
    benchmark::DoNotOptimize(store.add("suite", "run", results));
  }
  report_memory(state);
}

void night_read(benchmark::State& state) {
  results::Store store(empty_store());
  const auto id = store.add("suite", "run", night(state.range(0), false));
  for (auto _ : state) benchmark::DoNotOptimize(store.load(id));
  report_memory(state);
}

void nights_compared(benchmark::State& state) {
  const RunResults before = night(state.range(0), false);
  const RunResults after = night(state.range(0), true);
  for (auto _ : state)
    benchmark::DoNotOptimize(results::verdict_sentence(results::compare(before, after, results::Gates{})));
  report_memory(state);
}

BENCHMARK(nights_compared)->Arg(2000)->Arg(20000)->Arg(100000)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK(night_stored)->Arg(2000)->Arg(100000)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK(night_read)->Arg(2000)->Arg(100000)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
