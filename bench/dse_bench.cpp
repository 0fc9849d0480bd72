// Discrete segment evolution: CPU time per scan as the map grows, and on a recorded log.
//
// `corridor`: a corridor without end, with a door recess every 3 m, driven in steps of 10 cm: the map grows in
// proportion to the scans while what a scan sees stays alike. `log`: the scenario
// scenarios/logs/lakaemper2005_<name>.yaml, for which SCANBENCH_DATA names the folder of the logs. Counters: median and
// 95 % quantile of the milliseconds per scan, the slope of a line fitted to them against the lines of the map (us per
// 1000 lines), the lines of the map, peak memory of the process.
#include <benchmark/benchmark.h>

#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "core/registry.hpp"
#include "harness/runs/execute/make_recording.hpp"
#include "harness/study/scenario/scenario_file.hpp"
#include "tests/support/scan_builder.hpp"

namespace {

using namespace scanbench;

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Walls of the corridor within 12 m of x.
std::vector<Segment> corridor(double x) {
  std::vector<Segment> walls;
  const int first = static_cast<int>(x / 3) - 4;
  for (int k = first; k < first + 9; ++k) {
    const double at = 3.0 * k;
    const std::vector<Vec2> lower{{at, -1.2}, {at + 2, -1.2}, {at + 2, -1.35}, {at + 3, -1.35}, {at + 3, -1.2}};
    for (std::size_t i = 1; i < lower.size(); ++i) walls.push_back({lower[i - 1], lower[i]});
    walls.push_back({{at + 3, 1.2}, {at, 1.2}});
  }
  return walls;
}

struct Reading {
  double ms;
  double lines;
};

void report(benchmark::State& state, std::vector<Reading> readings) {
  double x = 0, y = 0, xx = 0, xy = 0;
  const auto n = static_cast<double>(readings.size());
  for (const Reading& r : readings) {
    x += r.lines / n;
    y += r.ms / n;
  }
  for (const Reading& r : readings) {
    xx += (r.lines - x) * (r.lines - x);
    xy += (r.lines - x) * (r.ms - y);
  }
  state.counters["us_per_1000_lines"] = xx > 0 ? 1e6 * xy / xx : 0.0;
  state.counters["lines"] = readings.back().lines;
  std::ranges::sort(readings, {}, &Reading::ms);
  state.counters["median_ms"] = readings[readings.size() / 2].ms;
  state.counters["p95_ms"] = readings[readings.size() * 95 / 100].ms;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["peak_MiB"] = static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// One scan extracted and inserted: only the insertion is timed.
class Drive {
 public:
  explicit Drive(const char* mapper, const ParamSet& params = {}) : mapper_(Registry<Mapper>::make(mapper, params)) {}
  void insert(const Scan& scan, const Pose2& guess) {
    const ScanLines lines = extractor_->extract(scan, silent_);
    const double begun = cpu_seconds();
    const Insertion inserted = mapper_->insert({scan, lines}, guess, silent_);
    readings_.push_back({1e3 * (cpu_seconds() - begun), static_cast<double>(inserted.lines)});
  }
  const std::vector<Reading>& readings() const { return readings_; }

 private:
  Trace silent_;
  std::unique_ptr<Mapper> mapper_;
  std::unique_ptr<LineExtractor> extractor_ = Registry<LineExtractor>::make("kovesi");
  std::vector<Reading> readings_;
};

void along_corridor(benchmark::State& state, const char* mapper) {
  for (auto _ : state) {
    Drive drive(mapper);
    const SensorModel sensor = support::fan_sensor(361, kPi);
    for (int k = 0; k < state.range(0); ++k) {
      const Pose2 pose(0.1 * k, 0, 0);
      const auto scan =
          support::with_noise(support::cast(sensor, corridor(pose.x()), pose), 0.01, 1, static_cast<std::uint32_t>(k));
      drive.insert(scan.view(), pose);
    }
    report(state, drive.readings());
  }
}

void log(benchmark::State& state, const char* mapper, const char* name) {
  if (std::getenv("SCANBENCH_DATA") == nullptr) {
    state.SkipWithError("SCANBENCH_DATA is not set");
    return;
  }
  const std::filesystem::path file =
      std::filesystem::path(SCANBENCH_SOURCE_DIR) / "scenarios/logs" / (std::string("lakaemper2005_") + name + ".yaml");
  const study::Scenario scenario = study::load_scenario(file);
  const Recording recording = runs::make_recording(scenario, 1, 1);
  for (auto _ : state) {
    Drive drive(mapper, {{"step_matcher", "icp"}, {"search_deg", 60.0}});  // as in the scenario
    for (std::size_t k = 0; k < recording.observed.frames.size(); ++k)
      drive.insert(recording.observed.scan(k), recording.observed.frames[k].odom_from_sensor);
    report(state, drive.readings());
  }
}

BENCHMARK_CAPTURE(along_corridor, dse, "dse")->Arg(1000)->Arg(4000)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(along_corridor, navigation_map, "navigation_map")
    ->Arg(1000)
    ->Arg(4000)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(log, dse_csail, "dse", "csail")->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(log, dse_intel, "dse", "intel")->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(log, dse_freiburg, "dse", "freiburg")->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(log, navigation_map_csail, "navigation_map", "csail")->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
