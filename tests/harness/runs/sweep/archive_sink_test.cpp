// The archive of a shard: what is put into it, and the folders that are used again.
#include "harness/runs/sweep/archive_sink.hpp"

#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "harness/io/files/atomic_file.hpp"
#include "harness/runs/execute/run_plan.hpp"
#include "harness/runs/store/recording_folder.hpp"
#include "harness/runs/sweep/shard_commit.hpp"
#include "tests/harness/runs/sweep/small_sweeps.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::runs {
namespace {

namespace fs = std::filesystem;

TEST(ArchiveSink, CommitsWhatWasPutAndUsesItsFoldersAgain) {
  const support::TemporaryFolder folder;
  const std::vector<study::Scenario> scenarios = fixtures::two_rooms();
  const RunPlan plan = plan_run(scenarios, {.out = folder.path() / "s"});
  std::vector<ArchivedCell> cells;
  std::set<fs::path> used;
  ArchiveSink sink(plan, folder.path() / "s", 1);
  for (const std::size_t index : {std::size_t{0}, plan.cells.size() - 1}) {
    const PlannedCell& planned = plan.cells[index];
    const CellKey key = plan.key(planned);
    io::StagedFolder recording = sink.begin(planned.group, recording_path("", key.scenario, key.seed));
    std::string hash = write_recording(recording.path(), fixtures::random_recording(key.seed, 2, 4, true));
    used.insert(recording.path());
    sink.put(FinishedRecording{planned.group, hash, sink.hashes_of(recording.path()), std::move(recording)});
    io::StagedFolder files = sink.begin(planned.group, cell_path("", key));
    EXPECT_TRUE(fs::is_empty(files.path()));
    used.insert(files.path());
    io::write_staged_file(files.path() / "timing.csv", "stage,frame,seconds\nextract,0,1\nextract,1,2\n");
    const std::string written = sink.hashes_of(files.path());
    io::write_staged_file(files.path() / "planted.csv", "by another program");
    sink.put(FinishedCell{
        .cell = index,
        .group = planned.group,
        .result = {.key = key, .done = true, .record = {{.status = CellStatus::ok, .message = ""}, "address"}},
        .summary = "",
        .file_hashes = written,
        .files = std::move(files)});
    const auto kept = sink.flush_if_due();
    ASSERT_EQ(kept.size(), 1u);
    EXPECT_EQ(kept[0].fault, "");
    cells.push_back(sink.take_cell(index));
    EXPECT_EQ(cells.back().scan_seconds, 1.5);
  }
  EXPECT_EQ(used.size(), 2u);
  const fs::path committed = sink.commit(cells, "scenario\n");
  const auto commits = load_commits(folder.path() / "s").whole;
  ASSERT_EQ(commits.size(), 1u);
  EXPECT_EQ(commits[0].folder, committed);
  EXPECT_EQ(commits[0].table.cells.size(), 2u);
  EXPECT_EQ(commits[0].table.recordings.size(), 2u);
  EXPECT_EQ(ArchiveReader(commits[0].archive()).files(cells[1].part, cell_path("", cells[1].key)).size(), 1u);
  EXPECT_EQ(fixtures::listing(committed).size(), 5u) << "commit.json, the archive and three tables";
}

}  // namespace
}  // namespace scanbench::runs
