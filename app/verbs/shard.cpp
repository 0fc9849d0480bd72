// sweep run: runs one shard of a sweep.
#include "app/verbs/shard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

#include "app/inputs.hpp"
#include "app/terminal/fault_notes.hpp"
#include "app/terminal/progress.hpp"
#include "app/terminal/running.hpp"
#include "harness/results/document/plain_text.hpp"
#include "harness/runs/store/cell_status.hpp"
#include "harness/runs/sweep/shard.hpp"

namespace scanbench::app {
namespace {

struct ShardVerbOptions {
  std::string sweep, shard;
  int jobs = 1;
  bool quiet = false;
};

/// Says how many cells of a shard are missing, and why the first one is. Returns their number.
std::size_t say_missing(const runs::ShardResult& result, int number) {
  const auto missing = std::ranges::count(result.cells, false, &runs::CellResult::done);
  if (missing == 0) return 0;
  const runs::CellResult& first = *std::ranges::find(result.cells, false, &runs::CellResult::done);
  say(fmt::format("scanbench: {} of {} of shard {} missing; run it again; {}: {}\n", missing,
                  counted(result.planned, "cell"), number, runs::to_string(first.key),
                  results::plain_line(first.record.outcome.message)));
  return static_cast<std::size_t>(missing);
}

int run_shard(const ShardVerbOptions& given) {
  check_run_exists(given.sweep);
  const int number = runs::shard_number(given.shard);
  Progress progress(progress_style(given.quiet));
  FaultNotes faults;
  runs::ShardOptions options{.shard = number, .jobs = given.jobs};
  options.progress = [&](const runs::RunProgress& now) {
    if (now.cell != nullptr && now.cell->record.outcome.status != runs::CellStatus::ok) {
      progress.failure();
      if (const std::string note = faults.note(*now.cell); !note.empty()) progress.note(note);
    }
    progress.update(now.total > 0 ? static_cast<double>(now.done) / static_cast<double>(now.total) : 0.0, now.what);
  };
  const runs::ShardResult result = runs::run_shard(given.sweep, options);
  for (const auto& line : faults.repeated()) progress.note(line);
  progress.finish();
  if (given.quiet) say(failed_text(result.cells));
  const std::size_t missing = say_missing(result, number);
  if (!given.quiet && result.earlier == result.planned)
    fmt::print("shard {}: {}, committed already\n", number, counted(result.planned, "cell"));
  if (!given.quiet && !result.committed.empty())
    fmt::print("shard {}: {} in {}\n", number, counted(result.cells.size() - missing, "cell"),
               result.committed.string());
  return result.exit_code();
}

}  // namespace

void add_shard(Verb& sweep) {
  auto options = std::make_shared<ShardVerbOptions>();
  Verb verb = sweep.add_verb("run", "Runs one shard of a sweep and commits its cells");
  verb.option("SWEEP", options->sweep, "the folder of a sweep").required();
  verb.option("--shard", options->shard,
              "its number; default: SLURM_ARRAY_TASK_ID, JOB_COMPLETION_INDEX + 1 or PARALLEL_SEQ");
  add_jobs_option(verb, options->jobs, "number of cells that run at the same time");
  verb.flag("-q,--quiet", options->quiet, "print only errors");
  verb.runs([options] { return run_shard(*options); });
}

}  // namespace scanbench::app
