// Sweeps: a plan, shards that are run in any order, stopped or out of disk, and the run that is merged from them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <sys/resource.h>

#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/system_error.hpp"
#include "harness/runs/execute/runner.hpp"
#include "harness/runs/store/cell_status.hpp"
#include "harness/runs/store/manifest.hpp"
#include "harness/runs/sweep/shard.hpp"
#include "harness/runs/sweep/slurm.hpp"
#include "harness/runs/sweep/sweep_merge.hpp"
#include "harness/runs/sweep/sweep_plan.hpp"
#include "harness/runs/sweep/sweep_status.hpp"
#include "harness/study/scenario/effective.hpp"
#include "tests/harness/runs/sweep/small_sweeps.hpp"
#include "tests/support/inputs.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::runs {
namespace {

namespace fs = std::filesystem;
using fixtures::commits_of;
using fixtures::cut;
using fixtures::kLine;
using fixtures::kSkip;
using fixtures::plan_of;
using fixtures::room;
using fixtures::run_all;
using fixtures::two_rooms;
using fixtures::with_time_two;

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(Sweep, MergedFromShardsHasTheBytesOfARun) {
  const support::TemporaryFolder folder;
  run(two_rooms(), {.out = folder.path() / "local"});
  for (const int shards : {1, 3, 5}) {
    SCOPED_TRACE(shards);
    const SweepPlan plan = plan_of(two_rooms(), folder.path() / ("sweep" + std::to_string(shards)), shards);
    EXPECT_EQ(plan.shards, shards);
    for (int shard = shards; shard >= 1; --shard) run_shard(plan.folder, {.shard = shard, .jobs = 1 + shard % 2});
    const fs::path merged = folder.path() / ("merged" + std::to_string(shards));
    const MergedSweep result = merge_sweep(load_sweep(plan.folder), {.out = merged});
    ASSERT_FALSE(result.missing);
    EXPECT_EQ(result.run.exit_code(), 0);
    EXPECT_EQ(fixtures::artefacts(merged), fixtures::artefacts(folder.path() / "local"));
    EXPECT_EQ(listed_hashes(merged).size(), listed_hashes(folder.path() / "local").size());
    EXPECT_EQ(load_manifest(merged).cells, load_manifest(folder.path() / "local").cells);
    EXPECT_EQ(load_manifest(merged).state, "complete");
  }
}

TEST(Sweep, KeepsTheCellsOfARecordingInOneShard) {
  const support::TemporaryFolder folder;
  const SweepPlan plan = plan_of(two_rooms(), folder.path() / "s", 4);
  std::map<std::pair<std::string, std::uint64_t>, std::set<int>> shards;
  for (const auto& cell : plan.cells) shards[{cell.key.scenario, cell.key.seed}].insert(cell.shard);
  EXPECT_EQ(shards.size(), 5u);
  std::set<int> used;
  for (const auto& [recording, numbers] : shards) {
    EXPECT_EQ(numbers.size(), 1u);
    used.insert(*numbers.begin());
  }
  EXPECT_THAT(used, ElementsAre(1, 2, 3, 4));
  EXPECT_EQ(plan_of(two_rooms(), folder.path() / "more", 1000).shards, 5) << "more shards than recordings";
}

TEST(Sweep, RefusesNumbersThatNoPlanHas) {
  const support::TemporaryFolder folder;
  for (const int shards : {0, -1, 1001})
    EXPECT_THAT(support::config_refusal([&] { plan_of(two_rooms(), folder.path() / "s", shards); }),
                HasSubstr("shards is " + std::to_string(shards) + "; allowed: 1 .. 1000"));
  const SweepPlan plan = plan_of(two_rooms(), folder.path() / "s", 3);
  for (const int shard : {0, 4})
    EXPECT_THAT(support::config_refusal([&] { run_shard(plan.folder, {.shard = shard}); }),
                HasSubstr("has no shard " + std::to_string(shard) + "; allowed: 1 .. 3"));
  EXPECT_THAT(commits_of(plan), IsEmpty());
}

TEST(Sweep, TakesTheNumberOfAShardFromTheFirstVariableThatIsSet) {
  for (const char* name : {"SLURM_ARRAY_TASK_ID", "JOB_COMPLETION_INDEX", "PARALLEL_SEQ"}) ::unsetenv(name);
  EXPECT_THAT(support::config_refusal([] { shard_number(""); }), HasSubstr("--shard N"));
  ::setenv("PARALLEL_SEQ", "4", 1);
  EXPECT_EQ(shard_number(""), 4);
  ::setenv("JOB_COMPLETION_INDEX", "0", 1);
  EXPECT_EQ(shard_number(""), 1);  // Kubernetes counts from 0
  ::setenv("SLURM_ARRAY_TASK_ID", "7", 1);
  EXPECT_EQ(shard_number(""), 7);
  EXPECT_EQ(shard_number("2"), 2);
  ::setenv("SLURM_ARRAY_TASK_ID", "", 1);
  EXPECT_THAT(support::config_refusal([] { shard_number(""); }), HasSubstr("SLURM_ARRAY_TASK_ID is ''"));
  for (const char* wrong : {"0", "1001", "x", "2x"})
    EXPECT_THAT(support::config_refusal([&] { shard_number(wrong); }),
                HasSubstr("--shard is '" + std::string(wrong) + "'"));
  for (const char* name : {"SLURM_ARRAY_TASK_ID", "JOB_COMPLETION_INDEX", "PARALLEL_SEQ"}) ::unsetenv(name);
}

TEST(Sweep, NamesWhatIsMissingAndMergesNothing) {
  const support::TemporaryFolder folder;
  const SweepPlan plan = plan_of(two_rooms(), folder.path() / "s", 5);
  run_shard(plan.folder, {.shard = 4});
  const SweepStatus status = sweep_status(plan);
  EXPECT_THAT(status.missing_shards, ElementsAre(1, 2, 3, 5));
  EXPECT_EQ(array_text(status.missing_shards), "1-3,5");
  EXPECT_EQ(status.ok, 1u);
  EXPECT_EQ(status.missing, 7u);
  const MergedSweep result = merge_sweep(plan, {.out = folder.path() / "run"});
  ASSERT_TRUE(result.missing);
  EXPECT_THAT(result.missing->shards, ElementsAre(1, 2, 3, 5));
  EXPECT_FALSE(fs::exists(folder.path() / "run"));
}

TEST(Sweep, ArraysAreWrittenAsSlurmReadsThem) {
  EXPECT_EQ(array_text({}), "");
  EXPECT_EQ(array_text({7}), "7");
  EXPECT_EQ(array_text({1, 2}), "1-2");
  EXPECT_EQ(array_text({1, 3, 4, 5, 9}), "1,3-5,9");
}

TEST(Sweep, AShardThatIsCommittedIsNotRunAgain) {
  const support::TemporaryFolder folder;
  const SweepPlan plan = plan_of(two_rooms(), folder.path() / "s");
  run_shard(plan.folder, {.shard = 1});
  const ShardResult again = run_shard(plan.folder, {.shard = 1});
  EXPECT_EQ(again.earlier, again.planned);
  EXPECT_TRUE(again.cells.empty());
  EXPECT_EQ(again.exit_code(), 0);
  EXPECT_EQ(commits_of(plan).size(), 1u);
}

TEST(Sweep, OneAddedCellRunsOneCell) {
  const support::TemporaryFolder folder;
  run_all(plan_of(two_rooms(), folder.path() / "s"));
  auto scenarios = two_rooms();
  scenarios[1].pipelines.push_back(room("two", "[5]", kSkip).pipelines[0]);
  scenarios[1].seeds = {5};
  const SweepPlan plan = plan_of(scenarios, folder.path() / "s", 100);
  EXPECT_EQ(plan.shards, 1);
  const ShardResult result = run_shard(plan.folder, {.shard = 1});
  ASSERT_EQ(result.cells.size(), 1u);
  EXPECT_EQ(to_string(result.cells[0].key), "two/skip/5");
  ASSERT_FALSE(merge_sweep(plan, {.out = folder.path() / "merged"}).missing);
  run(scenarios, {.out = folder.path() / "local"});
  EXPECT_EQ(fixtures::artefacts(folder.path() / "merged"), fixtures::artefacts(folder.path() / "local"));
}

TEST(Sweep, OneAddedSeedRunsItsCellsOnly) {
  const support::TemporaryFolder folder;
  run_all(plan_of({room("one", "{first: 1, count: 8}", kLine)}, folder.path() / "s", 4));
  const std::vector<study::Scenario> grown{room("one", "{first: 1, count: 9}", kLine)};
  const SweepPlan plan = plan_of(grown, folder.path() / "s", 4);
  EXPECT_EQ(plan.shards, 1);
  EXPECT_THAT(sweep_status(plan).missing_shards, ElementsAre(1));
  const ShardResult result = run_shard(plan.folder, {.shard = 1});
  ASSERT_EQ(result.cells.size(), 1u);
  EXPECT_EQ(to_string(result.cells[0].key), "one/line/9");
  ASSERT_FALSE(merge_sweep(plan, {.out = folder.path() / "merged"}).missing);
  run(grown, {.out = folder.path() / "local"});
  EXPECT_EQ(fixtures::artefacts(folder.path() / "merged"), fixtures::artefacts(folder.path() / "local"));
}

TEST(Sweep, RefusesAPlanThatWasEdited) {
  const support::TemporaryFolder folder;
  const auto replace = [](const fs::path& file, const std::string& piece, const std::string& by) {
    std::string text = io::read_file(file);
    const auto at = text.find(piece);
    ASSERT_NE(at, std::string::npos);
    io::write_file_atomically(file, text.replace(at, piece.size(), by));
  };
  const std::tuple<const char*, const char*, const char*> edits[] = {{"sweep.json", "\"shards\": 3", "\"shards\": 4"},
                                                                     {"cells.csv", "\n1,", "\n2,"},
                                                                     {"effective/one.yaml", "scans: 3", "scans: 4"}};
  for (const auto& [file, piece, by] : edits) {
    plan_of(two_rooms(), folder.path() / "s");
    replace(folder.path() / "s" / file, piece, by);
    EXPECT_THAT(support::config_refusal([&] { load_sweep(folder.path() / "s"); }),
                ::testing::AllOf(HasSubstr(file), HasSubstr("has been changed since the sweep was planned")));
  }
  cut(folder.path() / "s/sweep.json");
  EXPECT_THAT(support::config_refusal([&] { load_sweep(folder.path() / "s"); }), HasSubstr("sweep.json"));
}

TEST(Sweep, RefusesThePlanOfAnotherProgram) {
  const support::TemporaryFolder folder;
  SweepPlan plan = plan_of(two_rooms(), folder.path() / "s");
  EXPECT_NO_THROW(require_this_program(plan));
  plan.code = std::string(64, '0');
  plan.program = "scanbench 0.0.1 (of old)";
  EXPECT_THAT(support::config_refusal([&] { require_this_program(plan); }),
              HasSubstr("was planned by another program, scanbench 0.0.1 (of old)"));
  EXPECT_THAT(support::config_refusal([&] { merge_sweep(plan, {.out = folder.path() / "run"}); }),
              HasSubstr("another program"));
}

TEST(Sweep, RefusesFoldersThatAreNoSweep) {
  const support::TemporaryFolder folder;
  io::write_file_atomically(folder.path() / "thesis.tex", "years of work");
  EXPECT_THAT(support::config_refusal([&] { plan_of(two_rooms(), folder.path()); }), HasSubstr("stays unchanged"));
  EXPECT_THAT(support::config_refusal([&] { plan_of(two_rooms(), folder.path() / "thesis.tex"); }),
              HasSubstr("is a file"));
  EXPECT_THAT(support::config_refusal([&] { load_sweep(folder.path()); }), HasSubstr("it has no sweep.json"));
  EXPECT_THAT(fixtures::listing(folder.path()), ElementsAre("thesis.tex"));
}

TEST(Sweep, FailedCellsAreCommittedAndMerged) {
  const support::TemporaryFolder folder;
  const std::string pipelines = kLine + "  - {name: throws, extract: {module: test_throw}}\n";
  const SweepPlan plan = plan_of({room("one", "[1, 2]", pipelines)}, folder.path() / "s", 2);
  for (const int shard : {1, 2})
    EXPECT_EQ(run_shard(plan.folder, {.shard = shard, .recording = with_time_two}).exit_code(), 3);
  EXPECT_EQ(sweep_status(plan).failed, 2u);
  const MergedSweep result = merge_sweep(plan, {.out = folder.path() / "merged"});
  ASSERT_FALSE(result.missing);
  EXPECT_EQ(result.run.exit_code(), 3);
  EXPECT_THAT(fixtures::cell_of(result.run, "one/throws/1").record.outcome.message, HasSubstr("cannot go on"));
  run_with({room("one", "[1, 2]", pipelines)}, {.out = folder.path() / "local"},
           {.recording = with_time_two, .effective_yaml = study::effective_yaml});
  EXPECT_EQ(fixtures::artefacts(folder.path() / "merged"), fixtures::artefacts(folder.path() / "local"));
}

TEST(Sweep, SigtermLetsTheCurrentCellEndAndCommitsWhatIsDone) {
  const support::TemporaryFolder folder;
  const SweepPlan plan = plan_of({room("one", "[1, 2, 3]", kLine)}, folder.path() / "s", 1);
  ShardOptions options{.shard = 1};
  options.progress = [](const RunProgress& now) {
    if (now.what == "recording one/2") ::raise(SIGTERM);
  };
  const ShardResult stopped = run_shard(plan.folder, options);
  EXPECT_EQ(stopped.exit_code(), 4);
  EXPECT_FALSE(stopped.interrupted);
  // The only cell of the second recording belongs to the process that makes it. The third is not begun.
  EXPECT_EQ(std::ranges::count(stopped.cells, true, &CellResult::done), 2);
  EXPECT_EQ(sweep_status(plan).ok, 2u);
  const ShardResult rest = run_shard(plan.folder, {.shard = 1});
  EXPECT_EQ(rest.earlier, 2u);
  EXPECT_EQ(rest.exit_code(), 0);
  ASSERT_FALSE(merge_sweep(plan, {.out = folder.path() / "merged"}).missing);
  run({room("one", "[1, 2, 3]", kLine)}, {.out = folder.path() / "local"});
  EXPECT_EQ(fixtures::artefacts(folder.path() / "merged"), fixtures::artefacts(folder.path() / "local"));
}

TEST(Sweep, ACellThatTheSystemRefusesIsMissingAndTheOthersAreCommitted) {
  const support::TemporaryFolder folder;
  const std::string pipelines = kLine + "  - {name: full, extract: {module: test_full_disk}}\n";
  const SweepPlan plan = plan_of({room("one", "[1]", pipelines)}, folder.path() / "s", 1);
  const ShardResult result = run_shard(plan.folder, {.shard = 1, .recording = with_time_two});
  EXPECT_EQ(result.exit_code(), 4);
  EXPECT_EQ(sweep_status(plan).ok, 1u);
  EXPECT_EQ(sweep_status(plan).missing, 1u);
}

TEST(Sweep, AFullDiskLeavesNoCommit) {
  const support::TemporaryFolder folder;
  const SweepPlan plan = plan_of({room("one", "[1]", kLine)}, folder.path() / "s", 1);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit none{0, before.rlim_max};
  ShardOptions options{.shard = 1};
  options.progress = [&](const RunProgress& now) {
    if (now.cell != nullptr) setrlimit(RLIMIT_FSIZE, &none);  // after the last cell, before the commit
  };
  EXPECT_THROW(run_shard(plan.folder, options), io::SystemError);
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_THAT(fixtures::listing(plan.folder / "shards"), IsEmpty());
  EXPECT_EQ(sweep_status(plan).missing, 1u);
}

TEST(Sweep, SlurmScriptsQuotePathsAndMergeAfterAnyOutcome) {
  EXPECT_EQ(shell_word("plain/path-1.2"), "plain/path-1.2");
  EXPECT_EQ(shell_word("it's here"), "'it'\\''s here'");
  SweepPlan plan;
  plan.folder = "/data/my sweep";
  const SlurmScripts scripts = slurm_scripts(plan, {.program = "/opt/scanbench", .run = "/r", .jobs = 3});
  EXPECT_THAT(scripts.array, HasSubstr("exec /opt/scanbench sweep run '/data/my sweep' --jobs 3 --quiet\n"));
  EXPECT_THAT(scripts.array, HasSubstr("#SBATCH --cpus-per-task=3\n"));
  EXPECT_THAT(scripts.merge, HasSubstr("exec /opt/scanbench sweep merge '/data/my sweep' --out /r\n"));
}

}  // namespace
}  // namespace scanbench::runs
