// Tries cells on a few scans of some scenarios, and extends the results to all scans, seeds and scenarios.
#include "harness/runs/execute/forecast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "harness/runs/execute/cell_trial.hpp"
#include "harness/runs/execute/elapsed.hpp"
#include "harness/runs/execute/run_plan.hpp"
#include "harness/runs/execute/scan_source.hpp"

namespace scanbench::runs {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kSmallSample = 2;
constexpr std::size_t kLargeSample = 12;
constexpr std::size_t kVisits = 6;      // scenarios that are tried at least, if there are so many
constexpr double kLeastSeconds = 0.05;  // that a cell gets

/// Seconds and bytes of a part of a run as a line over the number of scans.
struct CostLine {
  TrialCost at_zero, each;

  TrialCost at(double scans) const {
    return {at_zero.seconds + each.seconds * scans, at_zero.bytes + each.bytes * scans};
  }
};

/// Through (n, cost) and the origin: of one sample.
CostLine through_origin(double n, const TrialCost& cost) {
  return {{}, {cost.seconds / std::max(n, 1.0), cost.bytes / std::max(n, 1.0)}};
}

/// Through two samples; it never falls, and ends at the larger one if they are of equal size.
CostLine through(double small, const TrialCost& a, double large, const TrialCost& b) {
  if (large <= small) return {b, {}};
  const TrialCost each{std::max(0.0, b.seconds - a.seconds) / (large - small),
                       std::max(0.0, b.bytes - a.bytes) / (large - small)};
  return {{std::max(0.0, b.seconds - each.seconds * large), std::max(0.0, b.bytes - each.bytes * large)}, each};
}

/// A part of a run that was tried: a cell, or the recording of a scenario.
struct Tried {
  std::size_t scenario = 0;
  CostLine cost;
  bool cut_off = false;
};

/// What is known of a scenario without running it, and its selected cells.
struct Candidate {
  const study::Scenario* scenario = nullptr;
  std::vector<const PlannedWork*> works;  // selected
  std::size_t scans = 0;
  double rays = 0.0;
  double reading_seconds = 0.0;
  std::string group;  // scenarios with the same pipelines are alike

  double beams() const { return scans > 0 ? rays / static_cast<double>(scans) : 0.0; }
};

std::string signature(const study::PipelineSpec& pipeline) {
  std::string text = pipeline.name;
  for (const auto& slot : pipeline.slots) text += "\n" + slot.kind + " " + slot.module;
  return text;
}

/// What a log is read with; two scenarios with the same have the same scans.
std::string log_key(const study::Scenario& scenario) {
  const auto* recorded = std::get_if<study::RecordedInput>(&scenario.input);
  if (recorded == nullptr) return "";
  std::string key = recorded->log.string() + "\n" + recorded->format;
  for (const auto& [name, value] : recorded->params) key += "\n" + name + "=" + to_text(value);
  return key;
}

bool grows_in_proportion(const study::Scenario& scenario) {
  const auto of_all_scans = [](const study::ModuleChoice& slot) {
    return slot.kind != "extract" && slot.kind != "match";
  };
  return std::ranges::none_of(scenario.pipelines,
                              [&](const study::PipelineSpec& p) { return std::ranges::any_of(p.slots, of_all_scans); });
}

/// The scenarios with selected cells, in their order.
std::vector<Candidate> candidates_of(const std::vector<study::Scenario>& scenarios, const RunPlan& plan,
                                     const RunOptions& options) {
  std::map<const study::Scenario*, std::vector<const PlannedWork*>> works;
  for (const PlannedWork& work : plan.works)
    if (selected(options, {work.scenario->name, work.pipeline->name, work.scenario->seeds.front()}))
      works[work.scenario].push_back(&work);
  std::map<std::string, Candidate> logs;
  std::vector<Candidate> candidates;
  for (const auto& scenario : scenarios) {
    if (!works.contains(&scenario)) continue;
    Candidate candidate{.scenario = &scenario, .works = works[&scenario], .group = ""};
    for (const PlannedWork* work : candidate.works) candidate.group += signature(*work->pipeline) + "\n\n";
    const std::string key = log_key(scenario);
    const auto known = key.empty() ? logs.end() : logs.find(key);
    if (known == logs.end()) {
      const ScanSource source(scenario);
      candidate.scans = source.scans();
      candidate.rays = source.rays();
      candidate.reading_seconds = source.reading_seconds();
      if (!key.empty()) logs.emplace(key, candidate);
    } else {
      candidate.scans = known->second.scans;
      candidate.rays = known->second.rays;
      candidate.reading_seconds = known->second.reading_seconds;
    }
    candidates.push_back(std::move(candidate));
  }
  return candidates;
}

/// The order in which scenarios are tried: one of each group, then a second one of each, and so on. Steps of the golden
/// section spread those of a group over its list, in which neighbours differ in one factor only.
std::vector<std::size_t> visiting_order(const std::vector<Candidate>& candidates) {
  std::vector<std::string> names;
  std::map<std::string, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (!groups.contains(candidates[i].group)) names.push_back(candidates[i].group);
    groups[candidates[i].group].push_back(i);
  }
  std::vector<std::pair<std::size_t, std::size_t>> order;  // round, scenario
  for (const auto& name : names) {
    std::vector<std::size_t> left = groups[name];
    double at = 0.5;
    for (std::size_t round = 0; !left.empty(); ++round) {
      const auto next = left.begin() + static_cast<std::ptrdiff_t>(at * static_cast<double>(left.size()));
      order.emplace_back(round, *next);
      left.erase(next);
      at = std::fmod(at + 0.6180339887498949, 1.0);
    }
  }
  std::ranges::stable_sort(order, {}, &std::pair<std::size_t, std::size_t>::first);
  std::vector<std::size_t> scenarios;
  for (const auto& [round, scenario] : order) scenarios.push_back(scenario);
  return scenarios;
}

class Forecaster {
 public:
  Forecaster(std::vector<Candidate> candidates, const RunOptions& options)
      : candidates_(std::move(candidates)), options_(options), faults_(candidates_.size()) {}

  Forecast run() {
    Forecast forecast;
    try_scenarios();
    forecast.interrupted = trials_.interrupted();
    if (forecast.interrupted) return forecast;
    forecast.tried = recordings_.size();
    std::set<std::string> unknown;
    for (std::size_t i = 0; i < candidates_.size(); ++i) forecast.scenarios.push_back(forecast_of(i, unknown));
    forecast.cut_off = unknown.size();
    return forecast;
  }

 private:
  double left() const { return kForecastSeconds - seconds_since(start_); }

  void try_scenarios() {
    const std::vector<std::size_t> order = visiting_order(candidates_);
    std::set<std::string> groups;
    for (const auto& candidate : candidates_) groups.insert(candidate.group);
    const std::size_t wanted = std::min(order.size(), std::max(groups.size(), kVisits));
    for (std::size_t i = 0; i < order.size() && !trials_.interrupted(); ++i) {
      if (left() <= 0.0 && i >= 1) break;
      const double share = left() / static_cast<double>(i < wanted ? wanted - i : 1);
      if (options_.progress)
        options_.progress({static_cast<std::size_t>(1000.0 * (1.0 - left() / kForecastSeconds)), 1000,
                           "trying " + candidates_[order[i]].scenario->name, nullptr});
      try_scenario(order[i], share);
    }
  }

  /// Tries the recording and the cells of a scenario, for about `seconds`.
  void try_scenario(std::size_t index, double seconds) {
    const Candidate& candidate = candidates_[index];
    const auto start = Clock::now();
    const ScanSource source(*candidate.scenario);
    const std::size_t n = std::min(kSmallSample, candidate.scans), m = std::min(kLargeSample, candidate.scans);
    std::vector<Recording> samples;
    std::vector<TrialCost> costs;
    for (const std::size_t count : {n, m}) {
      const auto begin = Clock::now();
      samples.push_back(source.sample(count, 1));
      const double making = seconds_since(begin);
      costs.push_back(trials_.write(samples.back()));
      costs.back().seconds += making;
    }
    const auto small = static_cast<double>(n), large = static_cast<double>(m);
    recordings_.push_back({index, through(small, costs[0], large, costs[1])});
    std::vector<const PlannedWork*> works = candidate.works;  // those first of which nothing is known
    std::ranges::stable_partition(works, [&](const PlannedWork* work) { return !is_known(*work); });
    for (std::size_t k = 0; k < works.size(); ++k) {
      const double rest = seconds - seconds_since(start);
      if (rest <= kLeastSeconds && (is_known(*works[k]) || left() <= 0.0)) return;
      try_cell(index, *works[k], samples, rest / static_cast<double>(works.size() - k));
      if (trials_.interrupted()) return;
    }
  }

  /// True if a trial of such a pipeline has ended.
  bool is_known(const PlannedWork& work) const {
    const auto known = cells_.find(signature(*work.pipeline));
    return known != cells_.end() && std::ranges::count(known->second, false, &Tried::cut_off) > 0;
  }

  /// `share`: the seconds of this cell, if all of its scenario are equal. It may take more from those that follow.
  void try_cell(std::size_t index, const PlannedWork& work, const std::vector<Recording>& samples, double share) {
    const auto small = static_cast<double>(samples[0].observed.frames.size());
    const auto large = static_cast<double>(samples[1].observed.frames.size());
    const CellTrial first = trials_.run(work, samples[0], std::max(kLeastSeconds, left() / 3));
    if (trials_.interrupted()) return;
    Tried tried{index, through_origin(small, first.cost), first.cut_off};
    std::string fault = first.fault;
    if (!first.cut_off && first.cost.seconds * large <= share * std::max(small, 1.0)) {
      const CellTrial second = trials_.run(work, samples[1], std::max(kLeastSeconds, left() / 3));
      if (trials_.interrupted()) return;
      fault = second.fault;
      if (!second.cut_off) tried.cost = through(small, first.cost, large, second.cost);
    }
    if (!fault.empty()) faults_[index].push_back(work.pipeline->name + ": " + fault);
    cells_[signature(*work.pipeline)].push_back(tried);
  }

  /// Of those that were tried and not cut off, if there are some: the scenario itself, else those of its group, else
  /// all: with the nearest number of beams.
  std::vector<const Tried*> nearest(std::size_t index, const std::vector<Tried>& tried) const {
    const auto distance = [&](const Tried& other) {
      const Candidate& a = candidates_[index];
      const Candidate& b = candidates_[other.scenario];
      const double beams = a.beams() > 0 && b.beams() > 0 ? std::abs(std::log(a.beams() / b.beams())) : 0.0;
      return std::tuple(other.cut_off, other.scenario != index, a.group != b.group, beams);
    };
    std::vector<const Tried*> found;
    for (const Tried& each : tried) {
      if (!found.empty() && distance(each) < distance(*found.front())) found.clear();
      if (found.empty() || distance(each) == distance(*found.front())) found.push_back(&each);
    }
    return found;
  }

  /// The mean over some that were tried, for a recording of the scenario; time and bytes of a scan grow with its beams.
  TrialCost cost_of(std::size_t index, const std::vector<const Tried*>& tried) const {
    TrialCost sum;
    const auto count = static_cast<double>(tried.size());
    for (const Tried* each : tried) {
      const double own = candidates_[index].beams(), other = candidates_[each->scenario].beams();
      const double scans = static_cast<double>(candidates_[index].scans) * (own > 0 && other > 0 ? own / other : 1.0);
      const TrialCost cost = each->cost.at(scans);
      sum = {sum.seconds + cost.seconds / count, sum.bytes + cost.bytes / count};
    }
    return sum;
  }

  /// Adds pipelines of which no trial has ended to `unknown`.
  ScenarioForecast forecast_of(std::size_t index, std::set<std::string>& unknown) const {
    const Candidate& candidate = candidates_[index];
    const auto seeds = static_cast<double>(candidate.scenario->seeds.size());
    ScenarioForecast forecast{.scenario = candidate.scenario->name,
                              .cells = candidate.scenario->seeds.size() * candidate.works.size(),
                              .scans = candidate.scans,
                              .rays = candidate.rays * seeds,
                              .in_proportion = grows_in_proportion(*candidate.scenario),
                              .faults = faults_[index]};
    const bool is_tried = std::ranges::count(recordings_, index, &Tried::scenario) > 0;
    forecast.sample = is_tried ? std::min(kLargeSample, candidate.scans) : 0;
    TrialCost sum = cost_of(index, nearest(index, recordings_));
    sum.seconds += candidate.reading_seconds;
    for (const PlannedWork* work : candidate.works) {
      if (!is_known(*work)) unknown.insert(signature(*work->pipeline));
      const auto known = cells_.find(signature(*work->pipeline));
      if (known == cells_.end()) continue;
      const auto tried = nearest(index, known->second);
      const TrialCost cost = cost_of(index, tried);
      sum = {sum.seconds + cost.seconds, sum.bytes + cost.bytes};
    }
    forecast.seconds = seeds * sum.seconds;
    forecast.bytes = seeds * sum.bytes;
    return forecast;
  }

  std::vector<Candidate> candidates_;
  const RunOptions& options_;
  std::vector<std::vector<std::string>> faults_;  // by scenario
  std::vector<Tried> recordings_;
  std::map<std::string, std::vector<Tried>> cells_;  // by signature
  CellTrials trials_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace

Forecast forecast_run(const std::vector<study::Scenario>& scenarios, const RunOptions& options) {
  const RunPlan plan = plan_run(scenarios, options);
  return Forecaster(candidates_of(scenarios, plan, options), options).run();
}

}  // namespace scanbench::runs
