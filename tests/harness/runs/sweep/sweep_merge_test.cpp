// Merges of sweeps: shards that ran twice, archives that are damaged, runs that keep their archives, and full disks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/hash.hpp"
#include "harness/io/files/system_error.hpp"
#include "harness/runs/execute/runner.hpp"
#include "harness/runs/store/archived_run.hpp"
#include "harness/runs/store/manifest.hpp"
#include "harness/runs/store/run_store.hpp"
#include "harness/runs/sweep/shard.hpp"
#include "harness/runs/sweep/shard_commit.hpp"
#include "harness/runs/sweep/sweep_merge.hpp"
#include "harness/runs/sweep/sweep_plan.hpp"
#include "harness/runs/sweep/sweep_status.hpp"
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

TEST(SweepMerge, TwoAttemptsAtOneShardMayBothCommit) {
  const support::TemporaryFolder folder;
  const SweepPlan plan = plan_of(two_rooms(), folder.path() / "s");
  run_all(plan);
  run_as_second_attempt(plan, 2);
  EXPECT_EQ(commits_of(plan, 2).size(), 2u);
  ASSERT_FALSE(merge_sweep(plan, {.out = folder.path() / "merged"}).missing);
  run(two_rooms(), {.out = folder.path() / "local"});
  EXPECT_EQ(fixtures::artefacts(folder.path() / "merged"), fixtures::artefacts(folder.path() / "local"));
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
  for (const auto& r : old->table.recordings)
    writer.add_recording(r.scenario, r.seed, edited(r.part, recording_path("", r.scenario, r.seed)));
  std::vector<ArchivedCell> cells;
  for (const auto& cell : old->table.cells) {
    cells.push_back(writer.add_cell(cell.key, cell.record, edited(cell.part, cell_path("", cell.key))));
    cells.back().summary_size = cell.summary_size;
  }
  fs::path made = writer.commit(cells, io::read_file(folder / "summary.csv"));
  fs::remove_all(folder);
  return made;
}

TEST(SweepMerge, RefusesTwoCommitsOfACellWithDifferentBytes) {
  for (const CellForm form : {CellForm::files, CellForm::archives}) {
    const support::TemporaryFolder folder;
    const SweepPlan plan = plan_of({room("one", "[1]", kLine)}, folder.path() / "s", 1);
    run_all(plan);
    run_as_second_attempt(plan, 1);
    commit_again(plan, commits_of(plan)[1], "timing.csv", "extract,0,1\n");  // times differ on every machine
    EXPECT_FALSE(merge_sweep(plan, {.out = folder.path() / "merged"}, form).missing);
    commit_again(plan, commits_of(plan)[0], "lines.csv", "2,9,0,0,1,1,0,0,0,1,2,0\n");
    const std::string message =
        support::config_refusal([&] { merge_sweep(plan, {.out = folder.path() / "other"}, form); });
    EXPECT_THAT(message, HasSubstr("the cell one/line/1 was committed twice with different lines.csv"));
    for (const fs::path& commit : commits_of(plan)) EXPECT_THAT(message, HasSubstr(commit.string()));
    EXPECT_FALSE(fs::exists(folder.path() / "other"));
  }
}

/// Replaces `from` in a file of the plan, and seals the plan again.
void tamper(const fs::path& sweep, const std::string& file, const std::string& from, const std::string& to) {
  std::string text = io::read_file(sweep / file);
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos);
  io::write_file_atomically(sweep / file, text.replace(at, from.size(), to));
  auto json = nlohmann::ordered_json::parse(io::read_file(sweep / "sweep.json"));
  for (auto& entry : json["files"])
    if (entry["path"] == file) entry["sha256"] = io::sha256_of_file(sweep / file);
  json.erase("seal");
  json["seal"] = io::sha256_hex(json.dump());
  io::write_file_atomically(sweep / "sweep.json", json.dump());
}

TEST(SweepMerge, ANameThatLeadsOutOfTheRunIsRefusedWithItsPlaceAlsoInASealedPlan) {
  const support::TemporaryFolder folder;
  const SweepPlan plan = plan_of({room("one", "[1, 2]", kLine)}, folder.path() / "s", 1);
  tamper(plan.folder, "cells.csv", ",one,line,2", ",one,../../../../PWNED,2");
  const std::string refusal = support::config_refusal([&] { load_sweep(plan.folder); });
  EXPECT_THAT(refusal, HasSubstr("cells.csv:3: the name of a pipeline is '../../../../PWNED'")) << refusal;
}

TEST(SweepMerge, RefusesTwoCommitsOfARecordingWithDifferentBytes) {
  const support::TemporaryFolder folder;
  run_all(plan_of({room("one", "[1]", kLine)}, folder.path() / "s", 1));
  const SweepPlan plan = plan_of({room("one", "[1]", kLine + kSkip)}, folder.path() / "s", 1);
  run_all(plan);
  ASSERT_EQ(commits_of(plan).size(), 2u);
  commit_again(plan, commits_of(plan)[0], "frames.csv", "\n");
  EXPECT_THAT(support::config_refusal([&] { merge_sweep(plan, {.out = folder.path() / "merged"}); }),
              HasSubstr("the recording one/1 was committed twice with different frames.csv"));
}

TEST(SweepMerge, NoticesArchivesThatAreCutOffAndRunsTheirShardAgain) {
  const support::TemporaryFolder folder;
  const SweepPlan plan = plan_of({room("one", "[1]", kLine + kSkip)}, folder.path() / "s", 1);
  run_all(plan);
  const fs::path archive = commits_of(plan)[0] / "cells.tar";
  cut(archive);
  const MergedSweep result = merge_sweep(plan, {.out = folder.path() / "run"});
  ASSERT_TRUE(result.missing);
  EXPECT_THAT(result.missing->shards, ElementsAre(1));
  EXPECT_THAT(result.missing->notes,
              ElementsAre(archive.string() + " is cut off or has been changed since it was committed"));
  EXPECT_FALSE(run_shard(plan.folder, {.shard = 1}).cells.empty());
  EXPECT_FALSE(merge_sweep(plan, {.out = folder.path() / "run"}).missing);
}

TEST(SweepMerge, AChangedByteOfAnArchiveCostsOneCellOnly) {
  const support::TemporaryFolder folder;
  const SweepPlan plan = plan_of({room("one", "[1]", kLine + kSkip)}, folder.path() / "s", 1);
  run_all(plan);
  const ShardCommit commit = load_commits(plan.folder).whole[0];
  std::string bytes = io::read_file(commit.archive());
  bytes[commit.table.cells[1].part.offset + 600] ^= 1;
  io::write_file_atomically(commit.archive(), bytes);
  const MergedSweep result = merge_sweep(plan, {.out = folder.path() / "run"});
  ASSERT_TRUE(result.missing);
  EXPECT_EQ(result.missing->count, 1u);
  EXPECT_EQ(run_shard(plan.folder, {.shard = 1}).cells.size(), 1u);
  ASSERT_FALSE(merge_sweep(plan, {.out = folder.path() / "run"}).missing);
  run({room("one", "[1]", kLine + kSkip)}, {.out = folder.path() / "local"});
  EXPECT_EQ(fixtures::artefacts(folder.path() / "run"), fixtures::artefacts(folder.path() / "local"));
}

TEST(SweepMerge, AnArchiveThatIsGoneCountsAsMissingCells) {
  const support::TemporaryFolder folder;
  const SweepPlan plan = plan_of({room("one", "[1]", kLine)}, folder.path() / "s", 1);
  run_all(plan);
  fs::remove(commits_of(plan)[0] / "cells.tar");
  EXPECT_TRUE(merge_sweep(plan, {.out = folder.path() / "run"}).missing);
  EXPECT_EQ(run_shard(plan.folder, {.shard = 1}).cells.size(), 1u);
}

TEST(SweepMerge, NoticesTablesThatAreCutOffAndRunsTheirShardAgain) {
  for (const char* file : {"commit.json", "cells.csv", "recordings.csv", "summary.csv"}) {
    SCOPED_TRACE(file);
    const support::TemporaryFolder folder;
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

TEST(SweepMerge, ArchivesOfShardsAreUnpackedByTar) {
  const support::TemporaryFolder folder;
  const SweepPlan plan = plan_of(two_rooms(), folder.path() / "s", 1);
  run_all(plan);
  fs::create_directory(folder.path() / "unpacked");
  const std::string command =
      "tar -xf " + (commits_of(plan)[0] / "cells.tar").string() + " -C " + (folder.path() / "unpacked").string();
  ASSERT_EQ(std::system(command.c_str()), 0);
  run(two_rooms(), {.out = folder.path() / "local"});
  auto local = fixtures::artefacts(folder.path() / "local");
  std::erase_if(local, [](const auto& file) {
    return !file.first.starts_with("cells/") && !file.first.starts_with("recordings/");
  });
  EXPECT_EQ(fixtures::artefacts(folder.path() / "unpacked"), local);
}

TEST(SweepMerge, MergedAsArchivesBecomesTheRunWhenItIsUnpacked) {
  const support::TemporaryFolder folder;
  run(two_rooms(), {.out = folder.path() / "local"});
  const SweepPlan plan = plan_of(two_rooms(), folder.path() / "s", 3);
  run_all(plan);
  const fs::path merged = folder.path() / "merged";
  const MergedSweep result = merge_sweep(plan, {.out = merged}, CellForm::archives);
  ASSERT_FALSE(result.missing);
  EXPECT_EQ(result.run.exit_code(), 0);
  EXPECT_EQ(io::read_file(merged / "summary.csv"), io::read_file(folder.path() / "local/summary.csv"));
  EXPECT_EQ(load_manifest(merged).cells, load_manifest(folder.path() / "local").cells);
  EXPECT_EQ(RunArchives(merged).table().cells.size(), 8u);
  EXPECT_EQ(RunArchives(merged).table().recordings.size(), 5u);
  EXPECT_TRUE(fs::exists(cell_path(merged, {"one", "line", 3}))) << "figures show the first seed";
  EXPECT_FALSE(fs::exists(cell_path(merged, {"one", "line", 1})));
  for (const auto& [path, hash] : listed_hashes(merged)) EXPECT_EQ(io::sha256_of_file(merged / path), hash) << path;
  EXPECT_TRUE(listed_hashes(merged).contains("archives/" + commits_of(plan)[0].filename().string() + ".tar"));

  EXPECT_EQ(unpack_cells(merged, {{"one", "line", 1}}), 1u);
  EXPECT_TRUE(has_archives(merged));
  EXPECT_TRUE(fs::exists(cell_path(merged, {"one", "line", 1})));
  EXPECT_THAT(support::config_refusal([&] { RunStore(merged).require_folders(); }),
              HasSubstr("`scanbench sweep unpack " + merged.string() + "` writes all of their files"));
  EXPECT_EQ(unpack_cells(merged, load_manifest(merged).cells), 4u);
  EXPECT_FALSE(has_archives(merged));
  EXPECT_EQ(fixtures::artefacts(merged), fixtures::artefacts(folder.path() / "local"));
  EXPECT_EQ(listed_hashes(merged).size(), listed_hashes(folder.path() / "local").size());
}

TEST(SweepMerge, AnArchivedRunHasTheRecordsAndValuesOfTheRun) {
  const support::TemporaryFolder folder;
  const std::string pipelines = kLine + "  - {name: throws, extract: {module: test_throw}}\n";
  const std::vector<study::Scenario> scenarios{room("one", "[1, 2]", pipelines)};
  const SweepPlan plan = plan_of(scenarios, folder.path() / "s", 2);
  for (const int shard : {1, 2}) run_shard(plan.folder, {.shard = shard, .recording = with_time_two});
  for (const auto& [name, form] : {std::pair("files", CellForm::files), std::pair("archives", CellForm::archives)})
    merge_sweep(plan, {.out = folder.path() / name}, form);
  const RunStore of_files(folder.path() / "files"), archived(folder.path() / "archives");
  for (const auto& cell : plan.cells) {
    const auto expected = of_files.record(cell.key), found = archived.record(cell.key);
    ASSERT_TRUE(expected && found);
    EXPECT_EQ(found->address, expected->address);
    EXPECT_EQ(found->outcome.status, expected->outcome.status);
    EXPECT_EQ(found->outcome.message, expected->outcome.message);
    EXPECT_EQ(found->outcome.cpu_seconds, expected->outcome.cpu_seconds);
  }
  EXPECT_FALSE(archived.record({"one", "line", 3}));
}

TEST(SweepMerge, UnpackingRefusesDamagedArchivesAndUnknownCells) {
  const support::TemporaryFolder folder;
  const SweepPlan plan = plan_of({room("one", "[1, 2]", kLine)}, folder.path() / "s", 1);
  run_all(plan);
  const fs::path merged = folder.path() / "merged";
  merge_sweep(plan, {.out = merged}, CellForm::archives);
  EXPECT_THAT(support::config_refusal([&] {
                unpack_cells(merged, {{"one", "line", 7}});
              }),
              HasSubstr("has no cell one/line/7"));
  const ArchivedCell cell = RunArchives(merged).table().cells[1];
  fs::resize_file(archive_path(merged, cell.archive), cell.part.offset + 700);
  EXPECT_THAT(support::config_refusal([&] { unpack_cells(merged, {cell.key}); }),
              HasSubstr("is cut off or has been changed"));
  EXPECT_FALSE(fs::exists(cell_path(merged, cell.key)));
  EXPECT_THAT(support::config_refusal([&] { run({room("one", "[1, 2]", kLine)}, {.out = merged, .resume = true}); }),
              HasSubstr("`scanbench sweep unpack"));
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

TEST(SweepMerge, CellsThatDoNotFitTheDiskAreMissingAndTheOthersAreCommitted) {
  const support::TemporaryFolder folder;
  const std::vector<study::Scenario> scenarios{room("one", "{first: 1, count: 12}", kLine)};
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
  EXPECT_EQ(fixtures::artefacts(folder.path() / "merged"), fixtures::artefacts(folder.path() / "local"));
}

TEST(SweepMerge, AMergeThatDoesNotFitTheDiskLeavesNothing) {
  const support::TemporaryFolder folder;
  const SweepPlan plan = plan_of(two_rooms(), folder.path() / "s");
  run_all(plan);
  for (const CellForm form : {CellForm::files, CellForm::archives}) {
    {
      const LargestFile limit(900);  // the manifest of a run that has just begun is smaller, its summary is not
      EXPECT_THROW(merge_sweep(plan, {.out = folder.path() / "new/run"}, form), io::SystemError);
    }
    EXPECT_FALSE(fs::exists(folder.path() / "new"));
  }
  merge_sweep(plan, {.out = folder.path() / "run"});
  const auto before = fixtures::artefacts(folder.path() / "run");
  {
    const LargestFile limit(900);
    EXPECT_THROW(merge_sweep(plan, {.out = folder.path() / "run"}), io::SystemError);
  }
  EXPECT_EQ(fixtures::artefacts(folder.path() / "run"), before);
}

}  // namespace
}  // namespace scanbench::runs
