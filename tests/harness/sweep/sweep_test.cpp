// Sweeps: a plan, shards that are run in any order, twice, cut off or stopped, and the run that is merged from them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <set>

#include <sys/resource.h>
#include <unistd.h>

#include "harness/files/atomic_file.hpp"
#include "harness/files/hash.hpp"
#include "harness/files/system_error.hpp"
#include "harness/run/make_recording.hpp"
#include "harness/run/runner.hpp"
#include "harness/scenario/effective.hpp"
#include "harness/scenario/scenario_file.hpp"
#include "harness/store/archived_run.hpp"
#include "harness/store/cell_status.hpp"
#include "harness/store/manifest.hpp"
#include "harness/sweep/shard.hpp"
#include "harness/sweep/shard_commit.hpp"
#include "harness/sweep/slurm.hpp"
#include "harness/sweep/sweep_merge.hpp"
#include "harness/sweep/sweep_plan.hpp"
#include "harness/sweep/sweep_status.hpp"
#include "tests/support/inputs.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::harness {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A room with these pipelines; recordings are small.
Scenario room(const std::string& name, const std::string& seeds, const std::string& pipelines) {
  return parse_scenario("schema: 1\nname: " + name + R"(
world: {segments: [[a, 0, 0, 10, 0], [b, 10, 0, 10, 8], [c, 10, 8, 0, 8], [d, 0, 8, 0, 0]]}
sensor: {preset: sick_lms200}
trajectory: {kind: waypoints, points_m: {A: [2, 2], B: [7, 5]}, scans: 3}
seeds: )" + seeds + "\npipelines:\n" +
                            pipelines + "metrics: [test_metrics]\nfigures: [test_traced]\n",
                        "room.yaml");
}

const std::string kLine = "  - {name: line, extract: {module: test_line}}\n";
const std::string kSkip = "  - {name: skip, extract: {module: test_line, params: {skip: 2}}}\n";

std::vector<Scenario> two_rooms() {
  return {room("one", "[3, 1, 2]", kLine + kSkip), room("two", "[5, 6]", kLine)};
}

/// Recordings with a scan of time 2, at which the modules of the tests misbehave.
Recording with_time_two(const Scenario&, std::uint64_t seed, int) {
  return testing::random_recording(seed, 5, 16, true);
}

SweepPlan plan_of(const std::vector<Scenario>& scenarios, const fs::path& out, int shards = 3) {
  return plan_sweep(scenarios, {.out = out, .name = "rooms", .shards = shards});
}

void run_all(const SweepPlan& plan) {
  for (int shard = 1; shard <= plan.shards; ++shard)
    EXPECT_EQ(run_shard(plan.folder, {.shard = shard}).exit_code(), 0) << shard;
}

/// The folders that shards have committed, of all shards or of one.
std::vector<fs::path> commits_of(const SweepPlan& plan, int shard = 0) {
  std::vector<fs::path> folders;
  for (const auto& commit : load_commits(plan.folder, shard).whole) folders.push_back(commit.folder);
  return folders;
}

void cut(const fs::path& file) {
  fs::resize_file(file, fs::file_size(file) / 2);
}

TEST(Sweep, MergedFromShardsHasTheBytesOfARun) {
  const testing::TemporaryFolder folder;
  run(two_rooms(), {.out = folder.path() / "local"});
  for (const int shards : {1, 3, 5}) {
    SCOPED_TRACE(shards);
    const SweepPlan plan = plan_of(two_rooms(), folder.path() / ("sweep" + std::to_string(shards)), shards);
    EXPECT_EQ(plan.shards, shards);
    for (int shard = shards; shard >= 1; --shard) run_shard(plan.folder, {.shard = shard, .jobs = 1 + shard % 2});
    const fs::path merged = folder.path() / ("merged" + std::to_string(shards));
    const MergeResult result = merge_sweep(load_sweep(plan.folder), {.out = merged});
    ASSERT_FALSE(result.missing);
    EXPECT_EQ(result.run.exit_code(), 0);
    EXPECT_EQ(testing::artefacts(merged), testing::artefacts(folder.path() / "local"));
    EXPECT_EQ(listed_hashes(merged).size(), listed_hashes(folder.path() / "local").size());
    EXPECT_EQ(load_manifest(merged).cells, load_manifest(folder.path() / "local").cells);
    EXPECT_EQ(load_manifest(merged).state, "complete");
  }
}

TEST(Sweep, KeepsTheCellsOfARecordingInOneShard) {
  const testing::TemporaryFolder folder;
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
  const testing::TemporaryFolder folder;
  for (const int shards : {0, -1, 1001})
    EXPECT_THAT(config_refusal([&] { plan_of(two_rooms(), folder.path() / "s", shards); }),
                HasSubstr("shards is " + std::to_string(shards) + "; allowed: 1 .. 1000"));
  const SweepPlan plan = plan_of(two_rooms(), folder.path() / "s", 3);
  for (const int shard : {0, 4})
    EXPECT_THAT(config_refusal([&] { run_shard(plan.folder, {.shard = shard}); }),
                HasSubstr("has no shard " + std::to_string(shard) + "; allowed: 1 .. 3"));
  EXPECT_THAT(commits_of(plan), IsEmpty());
}

TEST(Sweep, TakesTheNumberOfAShardFromTheFirstVariableThatIsSet) {
  for (const char* name : {"SLURM_ARRAY_TASK_ID", "JOB_COMPLETION_INDEX", "PARALLEL_SEQ"}) ::unsetenv(name);
  EXPECT_THAT(config_refusal([] { shard_number(""); }), HasSubstr("--shard N"));
  ::setenv("PARALLEL_SEQ", "4", 1);
  EXPECT_EQ(shard_number(""), 4);
  ::setenv("JOB_COMPLETION_INDEX", "0", 1);
  EXPECT_EQ(shard_number(""), 1);  // Kubernetes counts from 0
  ::setenv("SLURM_ARRAY_TASK_ID", "7", 1);
  EXPECT_EQ(shard_number(""), 7);
  EXPECT_EQ(shard_number("2"), 2);
  ::setenv("SLURM_ARRAY_TASK_ID", "", 1);
  EXPECT_THAT(config_refusal([] { shard_number(""); }), HasSubstr("SLURM_ARRAY_TASK_ID is ''"));
  for (const char* wrong : {"0", "1001", "x", "2x"})
    EXPECT_THAT(config_refusal([&] { shard_number(wrong); }), HasSubstr("--shard is '" + std::string(wrong) + "'"));
  for (const char* name : {"SLURM_ARRAY_TASK_ID", "JOB_COMPLETION_INDEX", "PARALLEL_SEQ"}) ::unsetenv(name);
}

TEST(Sweep, NamesWhatIsMissingAndMergesNothing) {
  const testing::TemporaryFolder folder;
  const SweepPlan plan = plan_of(two_rooms(), folder.path() / "s", 5);
  run_shard(plan.folder, {.shard = 4});
  const SweepStatus status = sweep_status(plan);
  EXPECT_THAT(status.missing_shards, ElementsAre(1, 2, 3, 5));
  EXPECT_EQ(array_text(status.missing_shards), "1-3,5");
  EXPECT_EQ(status.ok, 1u);
  EXPECT_EQ(status.missing, 7u);
  const MergeResult result = merge_sweep(plan, {.out = folder.path() / "run"});
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
  const testing::TemporaryFolder folder;
  const SweepPlan plan = plan_of(two_rooms(), folder.path() / "s");
  run_shard(plan.folder, {.shard = 1});
  const ShardResult again = run_shard(plan.folder, {.shard = 1});
  EXPECT_EQ(again.earlier, again.planned);
  EXPECT_TRUE(again.cells.empty());
  EXPECT_EQ(again.exit_code(), 0);
  EXPECT_EQ(commits_of(plan).size(), 1u);
}

TEST(Sweep, OneAddedCellRunsOneCell) {
  const testing::TemporaryFolder folder;
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
  EXPECT_EQ(testing::artefacts(folder.path() / "merged"), testing::artefacts(folder.path() / "local"));
}

TEST(Sweep, OneAddedSeedRunsItsCellsOnly) {
  const testing::TemporaryFolder folder;
  run_all(plan_of({room("one", "{first: 1, count: 8}", kLine)}, folder.path() / "s", 4));
  const std::vector<Scenario> grown{room("one", "{first: 1, count: 9}", kLine)};
  const SweepPlan plan = plan_of(grown, folder.path() / "s", 4);
  EXPECT_EQ(plan.shards, 1);
  EXPECT_THAT(sweep_status(plan).missing_shards, ElementsAre(1));
  const ShardResult result = run_shard(plan.folder, {.shard = 1});
  ASSERT_EQ(result.cells.size(), 1u);
  EXPECT_EQ(to_string(result.cells[0].key), "one/line/9");
  ASSERT_FALSE(merge_sweep(plan, {.out = folder.path() / "merged"}).missing);
  run(grown, {.out = folder.path() / "local"});
  EXPECT_EQ(testing::artefacts(folder.path() / "merged"), testing::artefacts(folder.path() / "local"));
}

/// A shard as another attempt commits it at the same time: it does not see the first commit.
void run_as_second_attempt(const SweepPlan& plan, int shard) {
  const fs::path aside = plan.folder / "aside";
  fs::rename(plan.folder / "shards", aside);
  fs::create_directory(plan.folder / "shards");
  run_shard(plan.folder, {.shard = shard});
  for (const auto& entry : fs::directory_iterator(aside))
    fs::rename(entry.path(), plan.folder / "shards" / entry.path().filename());
  fs::remove(aside);
}

TEST(Sweep, TwoAttemptsAtOneShardMayBothCommit) {
  const testing::TemporaryFolder folder;
  const SweepPlan plan = plan_of(two_rooms(), folder.path() / "s");
  run_all(plan);
  run_as_second_attempt(plan, 2);
  EXPECT_EQ(commits_of(plan, 2).size(), 2u);
  ASSERT_FALSE(merge_sweep(plan, {.out = folder.path() / "merged"}).missing);
  run(two_rooms(), {.out = folder.path() / "local"});
  EXPECT_EQ(testing::artefacts(folder.path() / "merged"), testing::artefacts(folder.path() / "local"));
}

/// Commits the cells and recordings of a commit again after an edit, in place of it: another machine made those bytes.
fs::path commit_again(const SweepPlan& plan, const fs::path& folder, const std::string& file, const std::string& more) {
  const auto commits = load_commits(plan.folder).whole;
  const auto old = std::ranges::find(commits, folder, &ShardCommit::folder);
  EXPECT_NE(old, commits.end());
  const ArchiveReader reader(old->archive());
  const auto edited = [&](const ArchivePart& part, const fs::path& of) {
    FolderFiles files = reader.files(part, of);
    if (const auto found = files.find(file); found != files.end()) found->second += more;
    return files;
  };
  CommitWriter writer(plan.folder, old->shard);
  for (const auto& r : old->recordings)
    writer.add_recording(r.scenario, r.seed, edited(r.part, recording_path("", r.scenario, r.seed)));
  std::vector<CommittedCell> cells;
  for (const auto& cell : old->cells) {
    cells.push_back(writer.add_cell(cell.key, cell.address, cell.outcome, edited(cell.part, cell_path("", cell.key))));
    cells.back().summary_size = cell.summary_size;
  }
  fs::path made = writer.commit(cells, read_file(folder / "summary.csv"));
  fs::remove_all(folder);
  return made;
}

TEST(Sweep, RefusesTwoCommitsOfACellWithDifferentBytes) {
  for (const CellForm form : {CellForm::files, CellForm::archives}) {
    const testing::TemporaryFolder folder;
    const SweepPlan plan = plan_of({room("one", "[1]", kLine)}, folder.path() / "s", 1);
    run_all(plan);
    run_as_second_attempt(plan, 1);
    commit_again(plan, commits_of(plan)[1], "timing.csv", "extract,0,1\n");  // times differ on every machine
    EXPECT_FALSE(merge_sweep(plan, {.out = folder.path() / "merged"}, form).missing);
    commit_again(plan, commits_of(plan)[0], "lines.csv", "2,9,0,0,1,1,0,0,0,1,2,0\n");
    const std::string message = config_refusal([&] { merge_sweep(plan, {.out = folder.path() / "other"}, form); });
    EXPECT_THAT(message, HasSubstr("the cell one/line/1 was committed twice with different lines.csv"));
    for (const fs::path& commit : commits_of(plan)) EXPECT_THAT(message, HasSubstr(commit.string()));
    EXPECT_FALSE(fs::exists(folder.path() / "other"));
  }
}

TEST(Sweep, RefusesTwoCommitsOfARecordingWithDifferentBytes) {
  const testing::TemporaryFolder folder;
  run_all(plan_of({room("one", "[1]", kLine)}, folder.path() / "s", 1));
  const SweepPlan plan = plan_of({room("one", "[1]", kLine + kSkip)}, folder.path() / "s", 1);
  run_all(plan);
  ASSERT_EQ(commits_of(plan).size(), 2u);
  commit_again(plan, commits_of(plan)[0], "frames.csv", "\n");
  EXPECT_THAT(config_refusal([&] { merge_sweep(plan, {.out = folder.path() / "merged"}); }),
              HasSubstr("the recording one/1 was committed twice with different frames.csv"));
}

TEST(Sweep, NoticesArchivesThatAreCutOffAndRunsTheirShardAgain) {
  const testing::TemporaryFolder folder;
  const SweepPlan plan = plan_of({room("one", "[1]", kLine + kSkip)}, folder.path() / "s", 1);
  run_all(plan);
  const fs::path archive = commits_of(plan)[0] / "cells.tar";
  cut(archive);
  const MergeResult result = merge_sweep(plan, {.out = folder.path() / "run"});
  ASSERT_TRUE(result.missing);
  EXPECT_THAT(result.missing->shards, ElementsAre(1));
  EXPECT_THAT(result.missing->notes,
              ElementsAre(archive.string() + " is cut off or has been changed since it was committed"));
  EXPECT_FALSE(run_shard(plan.folder, {.shard = 1}).cells.empty());
  EXPECT_FALSE(merge_sweep(plan, {.out = folder.path() / "run"}).missing);
}

TEST(Sweep, AChangedByteOfAnArchiveCostsOneCellOnly) {
  const testing::TemporaryFolder folder;
  const SweepPlan plan = plan_of({room("one", "[1]", kLine + kSkip)}, folder.path() / "s", 1);
  run_all(plan);
  const ShardCommit commit = load_commits(plan.folder).whole[0];
  std::string bytes = read_file(commit.archive());
  bytes[commit.cells[1].part.offset + 600] ^= 1;
  write_file_atomically(commit.archive(), bytes);
  const MergeResult result = merge_sweep(plan, {.out = folder.path() / "run"});
  ASSERT_TRUE(result.missing);
  EXPECT_EQ(result.missing->count, 1u);
  EXPECT_EQ(run_shard(plan.folder, {.shard = 1}).cells.size(), 1u);
  ASSERT_FALSE(merge_sweep(plan, {.out = folder.path() / "run"}).missing);
  run({room("one", "[1]", kLine + kSkip)}, {.out = folder.path() / "local"});
  EXPECT_EQ(testing::artefacts(folder.path() / "run"), testing::artefacts(folder.path() / "local"));
}

TEST(Sweep, AnArchiveThatIsGoneCountsAsMissingCells) {
  const testing::TemporaryFolder folder;
  const SweepPlan plan = plan_of({room("one", "[1]", kLine)}, folder.path() / "s", 1);
  run_all(plan);
  fs::remove(commits_of(plan)[0] / "cells.tar");
  EXPECT_TRUE(merge_sweep(plan, {.out = folder.path() / "run"}).missing);
  EXPECT_EQ(run_shard(plan.folder, {.shard = 1}).cells.size(), 1u);
}

TEST(Sweep, NoticesTablesThatAreCutOffAndRunsTheirShardAgain) {
  for (const char* file : {"commit.json", "cells.csv", "recordings.csv", "summary.csv"}) {
    SCOPED_TRACE(file);
    const testing::TemporaryFolder folder;
    const SweepPlan plan = plan_of({room("one", "[1]", kLine)}, folder.path() / "s", 1);
    run_all(plan);
    cut(commits_of(plan)[0] / file);
    const SweepStatus status = sweep_status(plan);
    ASSERT_EQ(status.damaged.size(), 1u);
    EXPECT_THAT(status.damaged[0].second, HasSubstr(file));
    EXPECT_EQ(status.missing, 1u);
    run_shard(plan.folder, {.shard = 1});
    EXPECT_FALSE(merge_sweep(plan, {.out = folder.path() / "run"}).missing);
  }
}

TEST(Sweep, ArchivesOfShardsAreUnpackedByTar) {
  const testing::TemporaryFolder folder;
  const SweepPlan plan = plan_of(two_rooms(), folder.path() / "s", 1);
  run_all(plan);
  fs::create_directory(folder.path() / "unpacked");
  const std::string command =
      "tar -xf " + (commits_of(plan)[0] / "cells.tar").string() + " -C " + (folder.path() / "unpacked").string();
  ASSERT_EQ(std::system(command.c_str()), 0);
  run(two_rooms(), {.out = folder.path() / "local"});
  auto local = testing::artefacts(folder.path() / "local");
  std::erase_if(local, [](const auto& file) {
    return !file.first.starts_with("cells/") && !file.first.starts_with("recordings/");
  });
  EXPECT_EQ(testing::artefacts(folder.path() / "unpacked"), local);
}

TEST(Sweep, MergedAsArchivesBecomesTheRunWhenItIsUnpacked) {
  const testing::TemporaryFolder folder;
  run(two_rooms(), {.out = folder.path() / "local"});
  const SweepPlan plan = plan_of(two_rooms(), folder.path() / "s", 3);
  run_all(plan);
  const fs::path merged = folder.path() / "merged";
  const MergeResult result = merge_sweep(plan, {.out = merged}, CellForm::archives);
  ASSERT_FALSE(result.missing);
  EXPECT_EQ(result.run.exit_code(), 0);
  EXPECT_EQ(read_file(merged / "summary.csv"), read_file(folder.path() / "local/summary.csv"));
  EXPECT_EQ(load_manifest(merged).cells, load_manifest(folder.path() / "local").cells);
  EXPECT_EQ(load_archive_tables(merged).cells.size(), 8u);
  EXPECT_EQ(load_archive_tables(merged).recordings.size(), 5u);
  EXPECT_TRUE(fs::exists(cell_path(merged, {"one", "line", 3}))) << "figures show the first seed";
  EXPECT_FALSE(fs::exists(cell_path(merged, {"one", "line", 1})));
  for (const auto& [path, hash] : listed_hashes(merged)) EXPECT_EQ(sha256_of_file(merged / path), hash) << path;
  EXPECT_TRUE(listed_hashes(merged).contains("archives/" + commits_of(plan)[0].filename().string() + ".tar"));

  EXPECT_EQ(unpack_cells(merged, {{"one", "line", 1}}), 1u);
  EXPECT_TRUE(has_archives(merged));
  EXPECT_NO_THROW(require_cell(merged, {"one", "line", 1}));
  EXPECT_THAT(config_refusal([&] {
                require_cell(merged, {"one", "line", 2});
              }),
              HasSubstr("`scanbench unpack " + merged.string() + " one/line/2` writes its files"));
  EXPECT_EQ(unpack_cells(merged, load_manifest(merged).cells), 4u);
  EXPECT_FALSE(has_archives(merged));
  EXPECT_EQ(testing::artefacts(merged), testing::artefacts(folder.path() / "local"));
  EXPECT_EQ(listed_hashes(merged).size(), listed_hashes(folder.path() / "local").size());
}

TEST(Sweep, AnArchivedRunHasTheRecordsAndValuesOfTheRun) {
  const testing::TemporaryFolder folder;
  const std::string pipelines = kLine + "  - {name: throws, extract: {module: test_throw}}\n";
  const std::vector<Scenario> scenarios{room("one", "[1, 2]", pipelines)};
  const SweepPlan plan = plan_of(scenarios, folder.path() / "s", 2);
  for (const int shard : {1, 2}) run_shard(plan.folder, {.shard = shard, .recording = with_time_two});
  for (const auto& [name, form] : {std::pair("files", CellForm::files), std::pair("archives", CellForm::archives)})
    merge_sweep(plan, {.out = folder.path() / name}, form);
  const CellRecords of_files(folder.path() / "files"), archived(folder.path() / "archives");
  for (const auto& cell : plan.cells) {
    const auto expected = of_files.of(cell.key), found = archived.of(cell.key);
    ASSERT_TRUE(expected && found);
    EXPECT_EQ(found->address, expected->address);
    EXPECT_EQ(found->outcome.status, expected->outcome.status);
    EXPECT_EQ(found->outcome.message, expected->outcome.message);
    EXPECT_EQ(found->outcome.cpu_seconds, expected->outcome.cpu_seconds);
  }
  EXPECT_FALSE(archived.of({"one", "line", 3}));
}

TEST(Sweep, UnpackingRefusesDamagedArchivesAndUnknownCells) {
  const testing::TemporaryFolder folder;
  const SweepPlan plan = plan_of({room("one", "[1, 2]", kLine)}, folder.path() / "s", 1);
  run_all(plan);
  const fs::path merged = folder.path() / "merged";
  merge_sweep(plan, {.out = merged}, CellForm::archives);
  EXPECT_THAT(config_refusal([&] { unpack_cells(merged, {{"one", "line", 7}}); }), HasSubstr("has no cell one/line/7"));
  const ArchivedCell cell = load_archive_tables(merged).cells[1];
  fs::resize_file(archive_path(merged, cell.archive), cell.part.offset + 700);
  EXPECT_THAT(config_refusal([&] { unpack_cells(merged, {cell.key}); }), HasSubstr("is cut off or has been changed"));
  EXPECT_FALSE(fs::exists(cell_path(merged, cell.key)));
  EXPECT_THAT(config_refusal([&] { run({room("one", "[1, 2]", kLine)}, {.out = merged, .resume = true}); }),
              HasSubstr("`scanbench unpack"));
}

TEST(Sweep, RefusesAPlanThatWasEdited) {
  const testing::TemporaryFolder folder;
  const auto replace = [](const fs::path& file, const std::string& piece, const std::string& by) {
    std::string text = read_file(file);
    const auto at = text.find(piece);
    ASSERT_NE(at, std::string::npos);
    write_file_atomically(file, text.replace(at, piece.size(), by));
  };
  const std::tuple<const char*, const char*, const char*> edits[] = {{"sweep.json", "\"shards\": 3", "\"shards\": 4"},
                                                                     {"cells.csv", "\n1,", "\n2,"},
                                                                     {"effective/one.yaml", "scans: 3", "scans: 4"}};
  for (const auto& [file, piece, by] : edits) {
    plan_of(two_rooms(), folder.path() / "s");
    replace(folder.path() / "s" / file, piece, by);
    EXPECT_THAT(config_refusal([&] { load_sweep(folder.path() / "s"); }),
                ::testing::AllOf(HasSubstr(file), HasSubstr("has been changed since the sweep was planned")));
  }
  cut(folder.path() / "s/sweep.json");
  EXPECT_THAT(config_refusal([&] { load_sweep(folder.path() / "s"); }), HasSubstr("sweep.json"));
}

TEST(Sweep, RefusesThePlanOfAnotherProgram) {
  const testing::TemporaryFolder folder;
  SweepPlan plan = plan_of(two_rooms(), folder.path() / "s");
  EXPECT_NO_THROW(require_this_program(plan));
  plan.code = std::string(64, '0');
  plan.program = "scanbench 0.0.1 (of old)";
  EXPECT_THAT(config_refusal([&] { require_this_program(plan); }),
              HasSubstr("was planned by another program, scanbench 0.0.1 (of old)"));
  EXPECT_THAT(config_refusal([&] { merge_sweep(plan, {.out = folder.path() / "run"}); }), HasSubstr("another program"));
}

TEST(Sweep, RefusesFoldersThatAreNoSweep) {
  const testing::TemporaryFolder folder;
  write_file_atomically(folder.path() / "thesis.tex", "years of work");
  EXPECT_THAT(config_refusal([&] { plan_of(two_rooms(), folder.path()); }), HasSubstr("stays unchanged"));
  EXPECT_THAT(config_refusal([&] { plan_of(two_rooms(), folder.path() / "thesis.tex"); }), HasSubstr("is a file"));
  EXPECT_THAT(config_refusal([&] { load_sweep(folder.path()); }), HasSubstr("it has no sweep.json"));
  EXPECT_THAT(testing::listing(folder.path()), ElementsAre("thesis.tex"));
}

TEST(Sweep, FailedCellsAreCommittedAndMerged) {
  const testing::TemporaryFolder folder;
  const std::string pipelines = kLine + "  - {name: throws, extract: {module: test_throw}}\n";
  const SweepPlan plan = plan_of({room("one", "[1, 2]", pipelines)}, folder.path() / "s", 2);
  for (const int shard : {1, 2})
    EXPECT_EQ(run_shard(plan.folder, {.shard = shard, .recording = with_time_two}).exit_code(), 3);
  EXPECT_EQ(sweep_status(plan).failed, 2u);
  const MergeResult result = merge_sweep(plan, {.out = folder.path() / "merged"});
  ASSERT_FALSE(result.missing);
  EXPECT_EQ(result.run.exit_code(), 3);
  EXPECT_THAT(testing::cell_of(result.run, "one/throws/1").record.outcome.message, HasSubstr("cannot go on"));
  run_with({room("one", "[1, 2]", pipelines)}, {.out = folder.path() / "local"},
           {.recording = with_time_two, .effective_yaml = effective_yaml});
  EXPECT_EQ(testing::artefacts(folder.path() / "merged"), testing::artefacts(folder.path() / "local"));
}

TEST(Sweep, SigtermLetsTheCurrentCellEndAndCommitsWhatIsDone) {
  const testing::TemporaryFolder folder;
  const SweepPlan plan = plan_of({room("one", "[1, 2, 3]", kLine)}, folder.path() / "s", 1);
  ShardOptions options{.shard = 1};
  options.progress = [](const RunProgress& now) {
    if (now.what == "recording one/2") ::raise(SIGTERM);
  };
  const ShardResult stopped = run_shard(plan.folder, options);
  EXPECT_EQ(stopped.exit_code(), 4);
  EXPECT_FALSE(stopped.interrupted);
  EXPECT_EQ(std::ranges::count(stopped.cells, true, &CellResult::done), 1);
  EXPECT_EQ(sweep_status(plan).ok, 1u);
  const ShardResult rest = run_shard(plan.folder, {.shard = 1});
  EXPECT_EQ(rest.earlier, 1u);
  EXPECT_EQ(rest.exit_code(), 0);
  ASSERT_FALSE(merge_sweep(plan, {.out = folder.path() / "merged"}).missing);
  run({room("one", "[1, 2, 3]", kLine)}, {.out = folder.path() / "local"});
  EXPECT_EQ(testing::artefacts(folder.path() / "merged"), testing::artefacts(folder.path() / "local"));
}

TEST(Sweep, ACellThatTheSystemRefusesIsMissingAndTheOthersAreCommitted) {
  const testing::TemporaryFolder folder;
  const std::string pipelines = kLine + "  - {name: full, extract: {module: test_full_disk}}\n";
  const SweepPlan plan = plan_of({room("one", "[1]", pipelines)}, folder.path() / "s", 1);
  const ShardResult result = run_shard(plan.folder, {.shard = 1, .recording = with_time_two});
  EXPECT_EQ(result.exit_code(), 4);
  EXPECT_EQ(sweep_status(plan).ok, 1u);
  EXPECT_EQ(sweep_status(plan).missing, 1u);
}

TEST(Sweep, AFullDiskLeavesNoCommit) {
  const testing::TemporaryFolder folder;
  const SweepPlan plan = plan_of({room("one", "[1]", kLine)}, folder.path() / "s", 1);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit none{0, before.rlim_max};
  ShardOptions options{.shard = 1};
  options.progress = [&](const RunProgress& now) {
    if (now.cell != nullptr) setrlimit(RLIMIT_FSIZE, &none);  // after the last cell, before the commit
  };
  EXPECT_THROW(run_shard(plan.folder, options), SystemError);
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_THAT(testing::listing(plan.folder / "shards"), IsEmpty());
  EXPECT_EQ(sweep_status(plan).missing, 1u);
}

/// No file that this process and its children write may have more bytes, while it exists.
class LargestFile {
 public:
  explicit LargestFile(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~LargestFile() { setrlimit(RLIMIT_FSIZE, &before_); }
  LargestFile(const LargestFile&) = delete;
  LargestFile& operator=(const LargestFile&) = delete;

 private:
  rlimit before_{};
};

TEST(Sweep, CellsThatDoNotFitTheDiskAreMissingAndTheOthersAreCommitted) {
  const testing::TemporaryFolder folder;
  const std::vector<Scenario> scenarios{room("one", "{first: 1, count: 12}", kLine)};
  const SweepPlan plan = plan_of(scenarios, folder.path() / "s", 1);
  {
    const LargestFile limit(150000);  // a cell with its recording has about 40 kB
    EXPECT_EQ(run_shard(plan.folder, {.shard = 1}).exit_code(), 4);
  }
  const SweepStatus status = sweep_status(plan);
  EXPECT_GT(status.ok, 0u);
  EXPECT_GT(status.missing, 0u);
  EXPECT_EQ(run_shard(plan.folder, {.shard = 1}).cells.size(), status.missing);
  ASSERT_FALSE(merge_sweep(plan, {.out = folder.path() / "merged"}).missing);
  run(scenarios, {.out = folder.path() / "local"});
  EXPECT_EQ(testing::artefacts(folder.path() / "merged"), testing::artefacts(folder.path() / "local"));
}

TEST(Sweep, AMergeThatDoesNotFitTheDiskLeavesNothing) {
  const testing::TemporaryFolder folder;
  const SweepPlan plan = plan_of(two_rooms(), folder.path() / "s");
  run_all(plan);
  for (const CellForm form : {CellForm::files, CellForm::archives}) {
    {
      const LargestFile limit(900);  // the manifest of a run that has just begun is smaller, its summary is not
      EXPECT_THROW(merge_sweep(plan, {.out = folder.path() / "new/run"}, form), SystemError);
    }
    EXPECT_FALSE(fs::exists(folder.path() / "new"));
  }
  merge_sweep(plan, {.out = folder.path() / "run"});
  const auto before = testing::artefacts(folder.path() / "run");
  {
    const LargestFile limit(900);
    EXPECT_THROW(merge_sweep(plan, {.out = folder.path() / "run"}), SystemError);
  }
  EXPECT_EQ(testing::artefacts(folder.path() / "run"), before);
}

TEST(Sweep, SlurmScriptsQuotePathsAndMergeAfterAnyOutcome) {
  EXPECT_EQ(shell_word("plain/path-1.2"), "plain/path-1.2");
  EXPECT_EQ(shell_word("it's here"), "'it'\\''s here'");
  SweepPlan plan;
  plan.folder = "/data/my sweep";
  const SlurmScripts scripts = slurm_scripts(plan, {.program = "/opt/scanbench", .run = "/r", .jobs = 3});
  EXPECT_THAT(scripts.array, HasSubstr("exec /opt/scanbench run --plan '/data/my sweep' --jobs 3 --quiet\n"));
  EXPECT_THAT(scripts.array, HasSubstr("#SBATCH --cpus-per-task=3\n"));
  EXPECT_THAT(scripts.merge, HasSubstr("exec /opt/scanbench merge '/data/my sweep' --out /r\n"));
}

}  // namespace
}  // namespace scanbench::harness
