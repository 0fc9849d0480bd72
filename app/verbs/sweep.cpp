// Plans sweeps, counts their cells, merges them, and submits them to Slurm.
#include "app/verbs/sweep.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/inputs.hpp"
#include "app/options.hpp"
#include "app/seed_list.hpp"
#include "app/terminal/progress.hpp"
#include "app/terminal/running.hpp"
#include "app/text_format.hpp"
#include "app/verbs/shard.hpp"
#include "app/verbs/unpack.hpp"
#include "core/error.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/descriptor.hpp"
#include "harness/io/files/json.hpp"
#include "harness/io/process/child.hpp"
#include "harness/io/process/pipe.hpp"
#include "harness/results/document/plain_text.hpp"
#include "harness/runs/store/cell_status.hpp"
#include "harness/runs/store/summary.hpp"
#include "harness/runs/sweep/slurm.hpp"
#include "harness/runs/sweep/sweep_merge.hpp"
#include "harness/runs/sweep/sweep_plan.hpp"
#include "harness/runs/sweep/sweep_status.hpp"

namespace scanbench::app {
namespace {

namespace fs = std::filesystem;

struct SweepVerbOptions {
  std::vector<std::string> files, sets, seeds, sbatch;
  std::string sweep, out, cells;
  int shards = runs::kShardsUnlessGiven, jobs = 1;
  bool quiet = false, json = false, numbers = false, journal = false, no_figures = false, dry_run = false;
};

runs::SweepPlan load(const std::string& sweep) {
  check_run_exists(sweep);
  return runs::load_sweep(sweep);
}

fs::path run_folder(const SweepVerbOptions& options, const runs::SweepPlan& plan) {
  return options.out.empty() ? fs::path("out") / plan.name : fs::path(options.out);
}

int plan(const SweepVerbOptions& options, const std::vector<std::string>& argv) {
  runs::SweepOptions sweep{.out = fs::path(options.out).lexically_normal(), .name = ""};
  auto scenarios = load_inputs(options.files, options.sets, &sweep.name, &sweep.rules);
  give_seeds(scenarios, options.seeds);
  sweep.shards = options.shards;
  sweep.journal = options.journal;
  sweep.argv = argv;
  const runs::SweepPlan plan = runs::plan_sweep(scenarios, sweep);
  if (options.quiet) return kGood;
  const runs::SweepStatus status = runs::sweep_status(plan);
  fmt::print("{}: {} in {}", options.out, counted(plan.cells.size(), "cell"),
             counted(static_cast<std::size_t>(plan.shards), "shard"));
  if (status.missing < status.cells) fmt::print("; {} committed already", status.cells - status.missing);
  fmt::print("\n");
  return kGood;
}

void note_damage(const runs::SweepStatus& status) {
  for (const auto& [name, fault] : status.damaged)
    say(fmt::format("note: {}; its cells count as missing\n", results::plain_line(fault)));
}

int exit_code(const runs::SweepStatus& status) {
  return status.missing > 0 ? kIncomplete : status.failed > 0 ? kCellsFailed : kGood;
}

void print_json(const runs::SweepPlan& plan, const runs::SweepStatus& status) {
  nlohmann::ordered_json damaged = nlohmann::ordered_json::array();
  for (const auto& [name, fault] : status.damaged) damaged.push_back({{"shard", name}, {"fault", fault}});
  const nlohmann::ordered_json json{{"cells", status.cells},
                                    {"ok", status.ok},
                                    {"failed", status.failed},
                                    {"missing", status.missing},
                                    {"shards", plan.shards},
                                    {"missing_shards", status.missing_shards},
                                    {"array", runs::array_text(status.missing_shards)},
                                    {"lost", status.lost},
                                    {"damaged", damaged},
                                    {"unfinished", status.unfinished}};
  fmt::print("{}\n", io::json_text(json));
}

int status(const SweepVerbOptions& options) {
  const runs::SweepPlan plan = load(options.sweep);
  const runs::SweepStatus status = runs::sweep_status(plan);
  note_damage(status);
  if (options.json) {
    print_json(plan, status);
  } else if (options.numbers) {
    for (const int shard : status.missing_shards) fmt::print("{}\n", shard);
  } else {
    fmt::print("{}: {} ok, {} failed, {} missing\n", counted(status.cells, "cell"), status.ok, status.failed,
               status.missing);
    if (!status.missing_shards.empty())
      fmt::print("missing shards: {} of {}: {}\n", status.missing_shards.size(), plan.shards,
                 runs::array_text(status.missing_shards));
    if (status.lost > 0)
      fmt::print("{} committed before the sweep was planned and missing now: plan it again\n",
                 counted(status.lost, "cell"));
    if (status.unfinished > 0) fmt::print("{} running or killed\n", counted(status.unfinished, "shard"));
  }
  return exit_code(status);
}

int report_missing(const std::string& sweep, const runs::MissingCells& missing) {
  for (const auto& note : missing.notes) say(fmt::format("note: {}\n", results::plain_line(note)));
  say(fmt::format("scanbench: {} of {} {} missing; nothing has been written\n", counted(missing.count, "cell"), sweep,
                  missing.count == 1 ? "is" : "are"));
  if (!missing.shards.empty())
    say(fmt::format("scanbench: run these shards again: {}\n", runs::array_text(missing.shards)));
  if (missing.lost > 0)
    say(fmt::format("scanbench: {} no shard; plan the sweep again\n",
                    missing.lost == 1 ? "1 cell has" : fmt::format("{} cells have", missing.lost)));
  return kIncomplete;
}

/// With more cells the report and the figures take longer than the merge.
constexpr std::size_t kMostReportedCells = 10000;

int merge(const SweepVerbOptions& options, const std::vector<std::string>& argv) {
  const runs::SweepPlan plan = load(options.sweep);
  runs::RunOptions run;
  run.out = run_folder(options, plan);
  run.argv = argv;
  std::optional<runs::MissingCells> missing;
  const runs::CellForm form = options.cells == "files"      ? runs::CellForm::files
                              : options.cells == "archives" ? runs::CellForm::archives
                                                            : runs::CellForm::automatic;
  const auto make = [&](const runs::RunOptions& ready) {
    runs::MergedSweep merged = runs::merge_sweep(plan, ready, form);
    missing = std::move(merged.missing);
    return std::move(merged.run);
  };
  const bool has_report = plan.cells.size() <= kMostReportedCells;
  const FinishedRun finished =
      make_and_report(make, run, {.quiet = options.quiet, .figures = !options.no_figures, .report = has_report});
  if (missing) return report_missing(options.sweep, *missing);
  const runs::RunResult& result = finished.result;
  say(failed_text(result.cells));
  if (!finished.figure_failure.empty()) say("scanbench: " + finished.figure_failure + "\n");
  if (!options.quiet && finished.report) {
    note_absent_figures(*finished.report);
    print_ending(finished);
  }
  if (!options.quiet && !has_report)
    fmt::print("{}: {}; `scanbench figures {}` draws its figures, `scanbench report {}` writes its report\n",
               (result.out / runs::kSummaryFile).string(), counted(plan.cells.size(), "cell"), result.out.string(),
               result.out.string());
  return result.exit_code() == kGood && !finished.figure_failure.empty() ? kCellsFailed : result.exit_code();
}

constexpr std::size_t kMostPrinted = 1 << 16;  // bytes kept of what sbatch prints

/// Runs a program and returns what it prints. Throws ConfigError if it cannot be started or fails.
std::string output_of(const std::vector<std::string>& command) {
  try {
    io::Pipe printed = io::make_pipe();
    io::Child child = io::start_program(
        command, {.input = io::kInherited, .output = printed.write_end.number(), .dies_with_parent = false});
    io::PipeReader text(std::move(printed.read_end), kMostPrinted);
    child.wait(std::numeric_limits<double>::infinity(), {&text});
    if (!child.reap().is_success()) throw ConfigError(fmt::format("{} failed", fmt::join(command, " ")));
    return text.bytes();
  } catch (const std::system_error& error) {
    throw ConfigError("cannot start " + command.front() + ": " + error.code().message() +
                      "; without Slurm, GNU parallel runs a sweep (docs/cluster.md)");
  }
}

/// The number of a job that `sbatch --parsable` prints: "17" or "17;cluster".
std::string job_number(const std::string& printed) {
  return printed.substr(0, printed.find_first_of(";\n"));
}

std::vector<std::string> sbatch(const SweepVerbOptions& options, const std::string& more, const fs::path& script) {
  std::vector<std::string> command{"sbatch", "--parsable"};
  command.insert(command.end(), options.sbatch.begin(), options.sbatch.end());
  command.push_back(more);
  command.push_back(fs::absolute(script).lexically_normal().string());
  return command;
}

std::string command_text(const std::vector<std::string>& command) {
  std::vector<std::string> words;
  for (const auto& word : command) words.push_back(runs::shell_word(word));
  return fmt::format("{}", fmt::join(words, " "));
}

int submit(const SweepVerbOptions& options) {
  const runs::SweepPlan plan = load(options.sweep);
  runs::require_this_program(plan);
  const runs::SweepStatus status = runs::sweep_status(plan);
  note_damage(status);
  if (status.lost > 0)
    throw ConfigError(options.sweep + " has missing cells without a shard; plan it again, then submit");
  if (status.missing_shards.empty())
    throw ConfigError(options.sweep + " has no missing cells; `scanbench sweep merge " + options.sweep +
                      "` makes the run");
  const auto scripts = runs::slurm_scripts(
      plan, {.program = fs::read_symlink("/proc/self/exe"), .run = run_folder(options, plan), .jobs = options.jobs});
  const fs::path folder = runs::slurm_folder(options.sweep);
  const auto array = sbatch(options, "--array=" + runs::array_text(status.missing_shards), folder / "array.sh");
  if (options.dry_run) {
    fmt::print("# {}\n{}\n# {}\n{}\n{}\n{}\n", (folder / "array.sh").string(), scripts.array,
               (folder / "merge.sh").string(), scripts.merge, command_text(array),
               command_text(sbatch(options, "--dependency=afterany:ARRAY_JOB", folder / "merge.sh")));
    return kGood;
  }
  io::make_folders(folder);
  io::write_file_atomically(folder / "array.sh", scripts.array);
  io::write_file_atomically(folder / "merge.sh", scripts.merge);
  const std::string first = job_number(output_of(array));
  const std::string second =
      job_number(output_of(sbatch(options, "--dependency=afterany:" + first, folder / "merge.sh")));
  fmt::print("job {}: shards {}; job {}: merge into {}\n", first, runs::array_text(status.missing_shards), second,
             run_folder(options, plan).string());
  return kGood;
}

void add_plan(Verb& sweep, const CommandLine& line) {
  auto options = std::make_shared<SweepVerbOptions>();
  Verb verb = sweep.add_verb(
      "plan", "Divides the cells of scenario or suite files into shards for several machines (docs/cluster.md)");
  verb.option("FILE", options->files, "scenario or suite files").required();
  verb.option("-o,--out", options->out, "the folder of the sweep").required();
  verb.option("--shards", options->shards, "most shards; a recording is never divided")
      .whole_number("number of shards", 1, runs::kMostShards)
      .shows_default();
  add_seed_option(verb, options->seeds);
  add_set_option(verb, options->sets);
  verb.flag("--trace", options->journal, "write the intermediate results of the algorithms (trace.csv)");
  verb.flag("-q,--quiet", options->quiet, "print only errors");
  verb.runs([&line, options] { return plan(*options, line.argv()); });
}

void add_status(Verb& sweep) {
  auto options = std::make_shared<SweepVerbOptions>();
  Verb verb = sweep.add_verb("status", "Counts the committed cells of a sweep, and names missing shards");
  verb.option("SWEEP", options->sweep, "the folder of a sweep").required();
  add_json_flag(verb, options->json, "the counts");
  verb.flag("--numbers", options->numbers, "print only the numbers of the missing shards, one per line");
  verb.runs([options] { return status(*options); });
}

void add_merge(Verb& sweep, const CommandLine& line) {
  auto options = std::make_shared<SweepVerbOptions>();
  Verb verb = sweep.add_verb("merge", "Makes an ordinary run folder from the shards of a sweep");
  verb.option("SWEEP", options->sweep, "the folder of a sweep").required();
  verb.option("-o,--out", options->out, "the run folder (default: out/<name of the first file>)");
  verb.flag("--no-figures", options->no_figures, "draw no figures");
  verb.option("--cells", options->cells,
              fmt::format("how the run keeps the files of its cells: files, or archives, from which `scanbench "
                          "sweep unpack` takes them (default: files up to {} cells)",
                          runs::kMostCellsAsFiles))
      .one_of("form", {"files", "archives"});
  verb.flag("-q,--quiet", options->quiet, "print only errors");
  verb.runs([&line, options] { return merge(*options, line.argv()); });
}

void add_submit(Verb& sweep) {
  auto options = std::make_shared<SweepVerbOptions>();
  Verb verb = sweep.add_verb("submit", "Submits a sweep to a batch system: missing shards, then the merge");
  verb.option("SYSTEM", "the batch system").required().one_of("batch system", {"slurm"});
  verb.option("SWEEP", options->sweep, "the folder of a sweep").required();
  verb.option("-o,--out", options->out, "folder of the merged run (default: out/<name of the first file>)");
  add_jobs_option(verb, options->jobs, "cells that run at the same time in each shard, and its processors");
  verb.option("--sbatch", options->sbatch, "an option for sbatch, like --sbatch=--time=0:30:00; may be repeated")
      .repeatable();
  verb.flag("--dry-run", options->dry_run, "print the scripts and commands; write and submit nothing");
  verb.runs([options] { return submit(*options); });
}

}  // namespace

void add_sweep(CommandLine& line) {
  Verb sweep = line.add_verb("sweep", "A suite on several machines: plan, run, status, merge, submit, unpack");
  sweep.details("docs/cluster.md is the guide.");
  add_plan(sweep, line);
  add_shard(sweep);
  add_status(sweep);
  add_merge(sweep, line);
  add_submit(sweep);
  add_unpack(sweep);
}

}  // namespace scanbench::app
