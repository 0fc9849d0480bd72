// Runs whose cells are in folders and in archives: what reads them finds the same.
#include "harness/runs/store/run_store.hpp"

#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/number_text.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/folder.hpp"
#include "harness/runs/store/archived_run.hpp"
#include "harness/runs/store/cell_files.hpp"
#include "harness/runs/store/recording_folder.hpp"
#include "tests/support/archives.hpp"
#include "tests/support/inputs.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::runs {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

/// A run with cells that are ok and cells that failed, in folders and in an archive.
class StoredRun : public ::testing::Test {
 protected:
  void SetUp() override {
    fixtures::run_here(
        {fixtures::scenario_with(
            "s", {fixtures::extract_with("a", "test_line"), fixtures::extract_with("b", "test_throw")}, {10, 9})},
        {.out = folders_});
    fs::copy(folders_, archived_, fs::copy_options::recursive);
    fixtures::archive_cells(archived_);
  }

  support::TemporaryFolder temporary_;
  fs::path folders_ = temporary_.path() / "folders";
  fs::path archived_ = temporary_.path() / "archived";
};

TEST_F(StoredRun, HasTheSameCellsAndRecordingsInFoldersAndInArchives) {
  ASSERT_FALSE(fs::exists(archived_ / "cells"));
  const RunStore folders(folders_), archived(archived_);
  ASSERT_EQ(folders.keys().size(), 4u);
  EXPECT_EQ(archived.keys(), folders.keys());
  for (const CellKey& key : folders.keys()) {
    const auto expected = folders.record(key), found = archived.record(key);
    ASSERT_TRUE(expected && found) << to_string(key);
    EXPECT_EQ(status_json(*found), status_json(*expected));
    EXPECT_EQ(archived.is_ok(key), key.pipeline == "a");
    EXPECT_EQ(archived.scan_seconds(key), folders.scan_seconds(key));
    EXPECT_EQ(archived.scan_seconds(key).has_value(), key.pipeline == "a");
    const auto names = io::names_in(cell_path(folders_, key));
    EXPECT_FALSE(names.empty());
    for (const auto& name : names) {
      ASSERT_TRUE(archived.files(key).has(name)) << name;
      EXPECT_EQ(archived.files(key).read(name), folders.files(key).read(name)) << name;
    }
    EXPECT_FALSE(archived.files(key).has("other.csv"));
  }
  EXPECT_THAT(folders.recordings(), ElementsAre(Pair("s", 9), Pair("s", 10)));
  EXPECT_EQ(archived.recordings(), folders.recordings());
  EXPECT_EQ(archived.recording_hash("s", 9), folders.recording_hash("s", 9));
  EXPECT_EQ(recording_hash(load_recording(archived.recording("s", 9))), folders.recording_hash("s", 9));
  EXPECT_EQ(load_result(archived.files({"s", "a", 9})).lines.size(), 5u);
}

TEST_F(StoredRun, HasTheSameMetricsWithoutTheirIntervals) {
  const RunStore folders(folders_), archived(archived_);
  const auto expected = folders.metrics({"s", "a", 9}), found = archived.metrics({"s", "a", 9});
  ASSERT_FALSE(expected.empty());
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].metric, expected[i].metric);
    EXPECT_EQ(found[i].subject, expected[i].subject);
    EXPECT_EQ(number_text(found[i].value), number_text(expected[i].value));
    EXPECT_EQ(found[i].unit, expected[i].unit);
    EXPECT_EQ(found[i].count, expected[i].count);
  }
  EXPECT_TRUE(archived.metrics({"s", "b", 9}).empty());
}

TEST_F(StoredRun, SaysWhatIsMissing) {
  for (const fs::path& run : {folders_, archived_}) {
    const RunStore store(run);
    EXPECT_FALSE(store.record({"s", "c", 9}));
    EXPECT_FALSE(store.files({"s", "c", 9}).exist());
    EXPECT_FALSE(store.recording("s", 11).exist());
    EXPECT_EQ(store.recording_hash("s", 11), "");
    EXPECT_THAT(support::config_refusal([&] {
                  store.files({"s", "a", 9}).read("other.csv");
                }),
                HasSubstr("cells/s/a/9/other.csv"));
  }
  EXPECT_NO_THROW(RunStore(folders_).require_folders());
  EXPECT_THAT(support::config_refusal([&] { RunStore(archived_).require_folders(); }),
              HasSubstr("`scanbench sweep unpack"));
}

TEST_F(StoredRun, TakesAFolderThatWasUnpackedBeforeTheArchive) {
  EXPECT_EQ(unpack_cells(archived_, {{"s", "a", 9}}), 1u);
  const RunStore store(archived_);
  EXPECT_FALSE(store.files({"s", "a", 9}).are_archived());
  EXPECT_TRUE(store.files({"s", "a", 10}).are_archived());
  EXPECT_FALSE(store.recording("s", 9).are_archived());
  EXPECT_EQ(store.recordings().size(), 2u);
}

TEST_F(StoredRun, RefusesADamagedArchive) {
  fs::resize_file(archived_ / "archives/1.tar", 1000);
  const RunStore store(archived_);
  EXPECT_TRUE(store.is_ok({"s", "a", 9}));
  EXPECT_THAT(support::config_refusal([&] {
                store.files({"s", "a", 9});
              }),
              HasSubstr("1.tar is cut off or has been changed"));
}

}  // namespace
}  // namespace scanbench::runs
