// Plans the cells of a run: scenarios x pipelines x seeds.
#include "harness/runs/execute/run_plan.hpp"

#include <algorithm>
#include <set>

#include "core/error.hpp"
#include "core/names.hpp"
#include "harness/io/files/placed_error.hpp"
#include "harness/runs/execute/cell_address.hpp"
#include "harness/study/scenario/figure_pipelines.hpp"

namespace scanbench::runs {
namespace {

void check_scenarios(const std::vector<study::Scenario>& scenarios, const RunOptions& options) {
  std::set<std::string> names;
  if (options.jobs < 1) throw ConfigError("jobs is " + std::to_string(options.jobs) + "; allowed: 1 or more");
  for (const auto& scenario : scenarios) {
    io::check_name("scenario", scenario.name);
    if (!names.insert(scenario.name).second)
      throw ConfigError("two scenarios have the name '" + scenario.name + "'; each needs a folder of its own");
    if (scenario.pipelines.empty())
      io::in_file(scenario.path.string(), {}, [&] {
        throw io::PlacedError(scenario.begin, "scenario '" + scenario.name +
                                                  "' has no pipelines; allowed: at least one in the key `pipelines` "
                                                  "(`scanbench simulate` makes recordings without any)");
      });
    std::set<std::string> pipelines;
    for (const auto& pipeline : scenario.pipelines) {
      io::check_name("pipeline", pipeline.name);
      if (!pipelines.insert(pipeline.name).second)
        throw ConfigError("scenario '" + scenario.name + "': two pipelines have the name '" + pipeline.name + "'");
    }
  }
  for (const auto& only : options.only) {
    std::vector<std::string> known;
    for (const auto& scenario : scenarios) {
      known.push_back(scenario.name);
      for (const auto& pipeline : scenario.pipelines)
        if (std::ranges::count(known, pipeline.name) == 0) known.push_back(pipeline.name);
    }
    const auto is_cell = [&](const study::Scenario& scenario) {
      return std::ranges::any_of(scenario.pipelines,
                                 [&](const auto& pipeline) { return only == scenario.name + "/" + pipeline.name; });
    };
    if (std::ranges::count(known, only) == 0 && std::ranges::none_of(scenarios, is_cell))
      throw ConfigError("no scenario or pipeline is named '" + only + "'" + known_names(only, known) +
                        "; or scenario/pipeline");
  }
}

void refuse_repeated(std::vector<std::uint64_t> seeds) {
  std::ranges::sort(seeds);
  const auto twice = std::ranges::adjacent_find(seeds);
  if (twice != seeds.end()) throw ConfigError("the seed " + std::to_string(*twice) + " is given twice");
}

/// The manifest lists about five files per cell; a run with more cells than this could not read its own.
void refuse_too_many_cells(const std::vector<study::Scenario>& scenarios) {
  constexpr std::size_t kMostCells = 200'000;
  std::size_t cells = 0;
  for (const auto& scenario : scenarios) cells += scenario.pipelines.size() * scenario.seeds.size();
  if (cells > kMostCells)
    throw ConfigError("the run would have " + std::to_string(cells) + " cells; allowed: at most " +
                      std::to_string(kMostCells) + "; divide its scenarios or seeds among several runs");
}

}  // namespace

CellKey RunPlan::key(const PlannedCell& cell) const {
  return {works[cell.work].scenario->name, works[cell.work].pipeline->name, groups[cell.group].seed};
}

std::string RunPlan::address(const PlannedCell& cell) const {
  const PlannedWork& work = works[cell.work];
  return cell_address(work.input, work.address, groups[cell.group].seed, trace(cell));
}

const study::TraceChoice& RunPlan::trace(const PlannedCell& cell) const {
  return cell.shown ? works[cell.work].shown : works[cell.work].others;
}

RunPlan plan_run(const std::vector<study::Scenario>& scenarios, const RunOptions& options) {
  check_scenarios(scenarios, options);
  refuse_too_many_cells(scenarios);
  RunPlan plan;
  for (const auto& scenario : scenarios) {
    const std::string input = input_address(scenario);
    const auto& seeds = scenario.seeds;
    const auto first = static_cast<std::uint32_t>(plan.groups.size());
    refuse_repeated(seeds);
    for (const std::uint64_t seed : seeds) plan.groups.push_back({&scenario, seed});
    for (const auto& pipeline : scenario.pipelines) {
      const auto work = static_cast<std::uint32_t>(plan.works.size());
      const study::TraceChoice all{.all = true};
      plan.works.push_back({.scenario = &scenario,
                            .pipeline = &pipeline,
                            .input = input,
                            .address = work_address(scenario.metrics, pipeline),
                            .shown = options.journal ? all : study::traces_drawn(scenario, pipeline.name),
                            .others = options.journal ? all : study::TraceChoice{}});
      for (std::uint32_t i = 0; i < seeds.size(); ++i)
        plan.cells.push_back({work, first + i, i == 0});  // figures show the first seed
    }
  }
  return plan;
}

bool selected(const RunOptions& options, const CellKey& key) {
  return options.only.empty() || std::ranges::any_of(options.only, [&](const std::string& only) {
           return only == key.scenario || only == key.pipeline || only == key.scenario + "/" + key.pipeline;
         });
}

}  // namespace scanbench::runs
