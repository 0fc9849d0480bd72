// Runs the cells of a shard into a folder of its own, which is then committed as a whole.
#include "harness/runs/sweep/shard.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "harness/runs/execute/make_recording.hpp"
#include "harness/runs/execute/run_plan.hpp"
#include "harness/runs/execute/summary_rows.hpp"
#include "harness/runs/sweep/archive_sink.hpp"
#include "harness/runs/sweep/shard_commit.hpp"
#include "harness/runs/sweep/sweep_plan.hpp"

namespace scanbench::runs {
namespace fs = std::filesystem;
namespace {

/// Batch systems send SIGKILL 30 s after SIGTERM, or later.
constexpr double kGraceSeconds = 20.0;

class Shard {
 public:
  Shard(SweepPlan sweep, const std::vector<study::Scenario>& scenarios, const ShardOptions& options)
      : sweep_(std::move(sweep)),
        options_(options),
        plan_(plan_run(scenarios, {.out = sweep_.folder, .jobs = options.jobs, .journal = sweep_.journal})),
        execution_(plan_, options.jobs, options.recording ? options.recording : simulated_or_read(),
                   {.ended = [this](std::size_t cell, CellResult result,
                                    const std::string& summary) { end_cell(cell, std::move(result), summary); },
                    .began_recording = [this](const std::string& what) { tell_progress(what, nullptr); },
                    .pause = [] {}}) {
    require_same_cells();
  }

  ShardResult run() {
    const auto committed = committed_addresses(sweep_.folder, options_.shard);
    for (std::size_t i = 0; i < sweep_.cells.size(); ++i) {
      if (sweep_.cells[i].shard != options_.shard) continue;
      ++result_.planned;
      if (committed.contains(sweep_.cells[i].address))
        ++result_.earlier;
      else
        waiting_.push_back(i);
    }
    if (waiting_.empty()) return std::move(result_);
    sweep_.cells = {};  // each child would get a copy
    for (const std::size_t cell : waiting_) execution_.add(cell);
    results_.resize(waiting_.size());
    summary_.emplace(waiting_.size());
    tell_progress("", nullptr);
    {
      ArchiveSink sink(plan_, sweep_.folder, options_.shard);
      execution_.work(sink, kGraceSeconds);
      result_.interrupted = execution_.interrupted() && !execution_.terminated();
      commit(sink);
    }  // an archive that was not committed is removed before an interrupt can come
    execution_.release();
    return std::move(result_);
  }

 private:
  static MakeRecording simulated_or_read() {
    return [](const study::Scenario& scenario, std::uint64_t seed, int threads) {
      return make_recording(scenario, seed, threads);
    };
  }

  /// The scenarios of the sweep, read back, give the cells of its list.
  void require_same_cells() const {
    bool same = plan_.cells.size() == sweep_.cells.size();
    for (std::size_t i = 0; same && i < plan_.cells.size(); ++i)
      same = plan_.key(plan_.cells[i]) == sweep_.cells[i].key &&
             (sweep_.cells[i].shard != options_.shard || plan_.address(plan_.cells[i]) == sweep_.cells[i].address);
    if (!same)
      throw ConfigError(sweep_.folder.string() +
                        ": the cells of its scenarios are not those of its list; plan it again");
  }

  std::size_t place_of(std::size_t cell) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(waiting_, cell) - waiting_.begin());
  }

  void end_cell(std::size_t cell, CellResult result, const std::string& summary) {
    const std::size_t at = place_of(cell);
    summary_->set(at, summary);
    results_[at] = std::move(result);
    ++done_;
    tell_progress(to_string(results_[at].key), &results_[at]);
  }

  void tell_progress(const std::string& what, const CellResult* cell) const {
    if (options_.progress) options_.progress({done_, waiting_.size(), what, cell});
  }

  void commit(ArchiveSink& sink) {
    std::vector<ArchivedCell> cells;
    for (std::size_t i = 0; i < waiting_.size(); ++i) {
      CellResult& result = results_[i];
      result.key = plan_.key(plan_.cells[waiting_[i]]);
      if (result.done) {
        cells.push_back(sink.take_cell(waiting_[i]));
        cells.back().summary_size = summary_->size(i);
      } else if (result.record.outcome.message.empty()) {
        result.record.outcome.message = "stopped before it was run";
      }
      result_.cells.push_back(std::move(result));
    }
    if (!cells.empty()) result_.committed = sink.commit(cells, summary_->text());
  }

  SweepPlan sweep_;
  const ShardOptions& options_;
  RunPlan plan_;
  Execution execution_;
  std::vector<std::size_t> waiting_;  ///< indices of the cells to run, ascending
  std::vector<CellResult> results_;   ///< of those
  std::optional<SummaryRows> summary_;
  ShardResult result_;
  std::size_t done_ = 0;
};

int number_of(const std::string& text, const std::string& source, int first) {
  int number = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (text.empty() || error != std::errc() || stop != end || number < first || number > kMostShards)
    throw ConfigError(source + " is '" + text + "'; allowed: the number of a shard");
  return number - first + 1;
}

}  // namespace

int ShardResult::exit_code() const {
  RunResult run;
  run.cells = cells;
  run.interrupted = interrupted;
  return run.exit_code();
}

ShardResult run_shard(const fs::path& sweep, const ShardOptions& options) {
  SweepPlan plan = load_sweep(sweep);
  require_this_program(plan);
  if (options.shard < 1 || options.shard > plan.shards)
    throw ConfigError(sweep.string() + " has no shard " + std::to_string(options.shard) +
                      (plan.shards == 0 ? ": all of its cells were committed when it was planned"
                                        : "; allowed: 1 .. " + std::to_string(plan.shards)));
  const std::vector<study::Scenario> scenarios = sweep_scenarios(plan);
  return Shard(std::move(plan), scenarios, options).run();
}

int shard_number(const std::string& option) {
  if (!option.empty()) return number_of(option, "--shard", 1);
  const std::pair<const char*, int> variables[] = {
      {"SLURM_ARRAY_TASK_ID", 1}, {"JOB_COMPLETION_INDEX", 0}, {"PARALLEL_SEQ", 1}};
  for (const auto& [name, first] : variables)
    if (const char* value = std::getenv(name)) return number_of(value, name, first);
  throw ConfigError(
      "sweep run needs the number of a shard: --shard N, or one of the variables SLURM_ARRAY_TASK_ID, "
      "JOB_COMPLETION_INDEX and PARALLEL_SEQ");
}

}  // namespace scanbench::runs
