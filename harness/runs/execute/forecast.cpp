// Small trial runs, extended to all scans.
#include "harness/runs/execute/forecast.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <set>
#include <system_error>
#include <variant>

#include "harness/io/files/system_error.hpp"
#include "harness/runs/execute/make_recording.hpp"
#include "harness/runs/execute/run_plan.hpp"
#include "harness/runs/execute/runner.hpp"
#include "harness/runs/store/cell_status.hpp"
#include "harness/study/scenario/effective.hpp"
#include "harness/study/scenario/simulation_input.hpp"
#include "sim/simulate.hpp"

namespace scanbench::runs {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kSmallSample = 2;
constexpr std::size_t kLargeSample = 12;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A new folder, removed with all that is in it.
class TrialFolder {
 public:
  TrialFolder() {
    std::string name = (fs::temp_directory_path() / "scanbench-forecast-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw io::SystemError("cannot make a folder in " + name);
    path_ = name;
  }
  ~TrialFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TrialFolder(const TrialFolder&) = delete;
  TrialFolder& operator=(const TrialFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

double bytes_below(const fs::path& folder) {
  double bytes = 0.0;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (entry->is_regular_file()) bytes += static_cast<double>(entry->file_size());
  return bytes;
}

/// The scans of a scenario, and how to make a recording of some that follow each other in the middle.
class Source {
 public:
  explicit Source(const study::Scenario& scenario) {
    const std::uint64_t seed = scenario.seeds.front();
    if (std::holds_alternative<study::SimulatedInput>(scenario.input)) {
      check_scenario(scenario);
      input_ = study::simulation_input(scenario, seed);
      scans_ = input_.trajectory.poses.size();
      rays_ = static_cast<double>(scans_) * input_.sensor.geometry.beams();
      return;
    }
    const auto start = Clock::now();
    recording_ = make_recording(scenario, seed, 1);
    reading_seconds_ = seconds_since(start);
    scans_ = recording_->observed.frames.size();
    for (const Frame& frame : recording_->observed.frames) rays_ += static_cast<double>(frame.ranges.size());
  }

  std::size_t scans() const { return scans_; }
  double rays() const { return rays_; }
  double reading_seconds() const { return reading_seconds_; }

  Recording sample(std::size_t count, int threads) const {
    const auto first = static_cast<std::ptrdiff_t>((scans_ - count) / 2);
    const auto last = first + static_cast<std::ptrdiff_t>(count);
    if (!recording_) {
      sim::SimulationInput part = input_;
      const auto& poses = input_.trajectory.poses;
      part.trajectory.poses.assign(poses.begin() + first, poses.begin() + last);
      return sim::simulate(part, threads);
    }
    Recording part = *recording_;
    part.observed.frames.assign(recording_->observed.frames.begin() + first,
                                recording_->observed.frames.begin() + last);
    if (part.truth) {
      const auto beams = static_cast<std::ptrdiff_t>(part.observed.sensor.geometry.beams());
      const Truth& whole = *recording_->truth;
      part.truth->world_from_sensor.assign(whole.world_from_sensor.begin() + first,
                                           whole.world_from_sensor.begin() + last);
      part.truth->ranges.assign(whole.ranges.begin() + first * beams, whole.ranges.begin() + last * beams);
      part.truth->wall_ids.assign(whole.wall_ids.begin() + first * beams, whole.wall_ids.begin() + last * beams);
    }
    return part;
  }

 private:
  sim::SimulationInput input_{};
  std::optional<Recording> recording_;  ///< of a log or of lines
  std::size_t scans_ = 0;
  double rays_ = 0.0;
  double reading_seconds_ = 0.0;
};

/// What one seed of a scenario takes on a number of scans.
struct Cost {
  double seconds = 0.0;
  double bytes = 0.0;
};

Cost try_scans(const study::Scenario& scenario, const Source& source, std::size_t count, ScenarioForecast& forecast,
               bool& interrupted) {
  const TrialFolder folder;
  RunOptions options;
  options.out = folder.path() / "run";
  const auto start = Clock::now();
  const RunResult result = run_with(
      {scenario}, options,
      {.recording = [&](const study::Scenario&, std::uint64_t, int threads) { return source.sample(count, threads); },
       .effective_yaml = study::effective_yaml});
  interrupted = result.interrupted;
  forecast.faults.clear();
  for (const CellResult& cell : result.cells)
    if (cell.record.outcome.status != CellStatus::ok)
      forecast.faults.push_back(fmt::format("{}: {}: {}", cell.key.pipeline, to_string(cell.record.outcome.status),
                                            cell.record.outcome.message));
  return {seconds_since(start), bytes_below(options.out / "recordings") + bytes_below(options.out / "cells")};
}

/// On the line through two samples; no less than the larger.
double extended(double small, double large, double scans_between, double scans_beyond) {
  const double each = scans_between > 0 ? std::max(0.0, large - small) / scans_between : 0.0;
  return large + each * scans_beyond;
}

bool grows_in_proportion(const study::Scenario& scenario) {
  const auto of_all_scans = [](const study::ModuleChoice& slot) {
    return slot.kind != "extract" && slot.kind != "match";
  };
  return std::ranges::none_of(scenario.pipelines,
                              [&](const study::PipelineSpec& p) { return std::ranges::any_of(p.slots, of_all_scans); });
}

/// The scenario with one seed and the selected pipelines; its figures are not drawn.
study::Scenario reduced(const study::Scenario& scenario, const std::set<std::string>& pipelines) {
  study::Scenario one = scenario;
  one.seeds = {scenario.seeds.front()};
  one.figures.clear();
  std::erase_if(one.pipelines, [&](const study::PipelineSpec& p) { return !pipelines.contains(p.name); });
  return one;
}

ScenarioForecast forecast_of(const study::Scenario& scenario, std::size_t seeds, bool& interrupted) {
  const Source source(scenario);
  ScenarioForecast forecast;
  forecast.scenario = scenario.name;
  forecast.cells = seeds * scenario.pipelines.size();
  forecast.scans = source.scans();
  forecast.rays = source.rays() * static_cast<double>(seeds);
  forecast.in_proportion = grows_in_proportion(scenario);
  const std::size_t small = std::min(kSmallSample, source.scans());
  forecast.sample = std::min(kLargeSample, source.scans());
  const Cost a = try_scans(scenario, source, small, forecast, interrupted);
  if (interrupted) return forecast;
  const Cost b = try_scans(scenario, source, forecast.sample, forecast, interrupted);
  const auto between = static_cast<double>(forecast.sample - small);
  const auto beyond = static_cast<double>(source.scans() - forecast.sample);
  const auto times = static_cast<double>(seeds);
  forecast.bytes = times * extended(a.bytes, b.bytes, between, beyond);
  forecast.seconds = times * (extended(a.seconds, b.seconds, between, beyond) + source.reading_seconds());
  return forecast;
}

}  // namespace

Forecast forecast_run(const std::vector<study::Scenario>& scenarios, const RunOptions& options) {
  const RunPlan plan = plan_run(scenarios, options);
  Forecast forecast;
  for (std::size_t i = 0; i < scenarios.size() && !forecast.interrupted; ++i) {
    if (options.progress) options.progress({i, scenarios.size(), "trying " + scenarios[i].name, nullptr});
    std::set<std::string> pipelines;
    for (const PlannedCell& cell : plan.cells)
      if (plan.works[cell.work].scenario == &scenarios[i] && selected(options, plan.key(cell)))
        pipelines.insert(plan.works[cell.work].pipeline->name);
    if (pipelines.empty()) continue;
    forecast.scenarios.push_back(
        forecast_of(reduced(scenarios[i], pipelines), scenarios[i].seeds.size(), forecast.interrupted));
  }
  return forecast;
}

}  // namespace scanbench::runs
