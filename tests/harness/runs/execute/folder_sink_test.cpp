// Folders that are put in place together: when they appear, and what becomes of cells whose recording is lost.
#include "harness/runs/execute/folder_sink.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/hash.hpp"
#include "harness/runs/store/recording_folder.hpp"
#include "harness/runs/store/written_hashes.hpp"
#include "tests/support/inputs.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::runs {
namespace {

namespace fs = std::filesystem;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class FolderSinkTest : public ::testing::Test {
 protected:
  FinishedCell cell(std::size_t group, const std::string& place) {
    io::StagedFolder files = sink_.begin(group, place);
    io::write_staged_file(files.path() / "lines.csv", place);
    std::string hashes = sink_.hashes_of(files.path());
    return {.cell = group,
            .group = group,
            .result = {.key = {}, .record = {}},
            .summary = "",
            .file_hashes = std::move(hashes),
            .files = std::move(files)};
  }

  FinishedRecording recording(std::size_t group, std::uint64_t seed) {
    io::StagedFolder files = sink_.begin(group, recording_path("", "s", group));
    std::string hash = write_recording(files.path(), fixtures::random_recording(seed, 2, 4, true));
    return {group, std::move(hash), sink_.hashes_of(files.path()), std::move(files)};
  }

  support::TemporaryFolder folder_;
  fs::path run_ = folder_.path() / "r";
  WrittenHashes written_;
  FolderSink sink_{run_, written_};
};

TEST_F(FolderSinkTest, CellsAppearWhenTheyAreFlushedAndTheirHashesAreKnown) {
  sink_.put(cell(0, "cells/s/a/1"));
  EXPECT_FALSE(fs::exists(run_ / "cells/s/a/1"));
  const auto kept = sink_.flush();
  ASSERT_THAT(kept, SizeIs(1));
  EXPECT_EQ(kept[0].fault, "");
  EXPECT_EQ(io::read_file(run_ / "cells/s/a/1/lines.csv"), "cells/s/a/1");
  EXPECT_THAT(sink_.flush(), IsEmpty());
  const auto hashes = written_.take();
  ASSERT_THAT(hashes, SizeIs(1));
  EXPECT_EQ(hashes.at("cells/s/a/1/lines.csv"), io::sha256_hex("cells/s/a/1"));
}

TEST_F(FolderSinkTest, WhatIsNeverFlushedLeavesNothing) {
  {
    FolderSink sink(run_, written_);
    sink.put(cell(0, "cells/s/a/1"));
  }
  EXPECT_THAT(fixtures::listing(run_ / "cells/s/a"), IsEmpty());
}

TEST_F(FolderSinkTest, ALostRecordingLosesItsCellsOnly) {
  FinishedRecording lost = recording(0, 1);
  fs::remove_all(lost.files.path());
  sink_.put(std::move(lost));
  sink_.put(recording(1, 1));
  sink_.put(cell(0, "cells/s/a/0"));
  sink_.put(cell(1, "cells/s/a/1"));
  const auto kept = sink_.flush();
  ASSERT_THAT(kept, SizeIs(2));
  EXPECT_NE(kept[0].fault, "");
  EXPECT_EQ(kept[1].fault, "");
  EXPECT_FALSE(fs::exists(run_ / "cells/s/a/0"));
  EXPECT_TRUE(fs::exists(run_ / "cells/s/a/1"));
  EXPECT_EQ(support::config_refusal([&] { sink_.begin(0, "cells/s/b/0"); }), kept[0].fault);
  EXPECT_NO_THROW(sink_.begin(1, "cells/s/b/1"));
}

TEST_F(FolderSinkTest, ARecordingReplacesOnlyOneThatDiffers) {
  const fs::path place = recording_path(run_, "s", 0);
  save_recording(place, fixtures::random_recording(1, 2, 4, true));
  io::write_file_atomically(place / "note.txt", "of the old one");
  sink_.put(recording(0, 1));
  sink_.flush();
  EXPECT_TRUE(fs::exists(place / "note.txt"));
  sink_.put(recording(0, 2));
  sink_.flush();
  EXPECT_FALSE(fs::exists(place / "note.txt"));
  EXPECT_EQ(stated_recording_hash(place), recording_hash(fixtures::random_recording(2, 2, 4, true)));
}

}  // namespace
}  // namespace scanbench::runs
