// Tables of archived cells: what is written is read back, and tables of earlier versions are read.
#include "harness/runs/store/cell_table.hpp"

#include <string>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "harness/runs/store/summary.hpp"

namespace scanbench::runs {
namespace {

const std::string kRecordings = "scenario,seed,content_hash,archive,offset,bytes,sha256\nroom,7,cc,1.a.tar,0,512,dd\n";

TEST(CellTable, IsReadBackWithThePlacesOfItsSummaries) {
  const ArchivedCell first{.key = {"room, one", "iepf", 7},
                           .record = {{.status = CellStatus::timeout,
                                       .message = "a \"line\"\nanother",
                                       .wall_seconds = 0.1,
                                       .cpu_seconds = 0.2,
                                       .peak_memory_bytes = 3e9},
                                      "aa"},
                           .scan_seconds = 0.125,
                           .result = "bb",
                           .summary_begin = 0,
                           .summary_size = 40,
                           .archive = "cells.tar",
                           .part = {1024, 2048, "ee"}};
  ArchivedCell second = first;
  second.key.seed = 8;
  const CellTable table = parse_cell_table(cells_csv({first, second}), kRecordings, "run");
  ASSERT_EQ(table.cells.size(), 2u);
  const ArchivedCell& read = table.cells[0];
  EXPECT_EQ(read.key, first.key);
  EXPECT_EQ(status_json(read.record), status_json(first.record));
  EXPECT_EQ(read.scan_seconds, 0.125);
  EXPECT_EQ(read.result, "bb");
  EXPECT_EQ(read.archive, "cells.tar");
  EXPECT_EQ(read.part.offset, 1024u);
  EXPECT_EQ(read.part.bytes, 2048u);
  EXPECT_EQ(read.part.sha256, "ee");
  EXPECT_EQ(read.summary_begin, summary_header().size());
  EXPECT_EQ(table.cells[1].summary_begin, summary_header().size() + 40);
  EXPECT_EQ(recordings_csv(table.recordings), kRecordings);
  EXPECT_EQ(table.recording("room", 7), table.recordings.data());
  EXPECT_EQ(table.recording("room", 8), nullptr);
}

TEST(CellTable, OfAnEarlierVersionIsRead) {
  const CellTable run = parse_cell_table(
      "scenario,pipeline,seed,status,message,wall_seconds,cpu_seconds,peak_memory_bytes,scan_seconds,address,archive,"
      "offset,bytes,sha256\nroom,iepf,7,ok,,1,2,3,0.5,aa,1.a.tar,512,1024,ee\n",
      kRecordings, "run");
  ASSERT_EQ(run.cells.size(), 1u);
  EXPECT_EQ(run.cells[0].archive, "1.a.tar");
  EXPECT_EQ(run.cells[0].record.address, "aa");
  EXPECT_EQ(run.cells[0].result, "");
  const CellTable shard = parse_cell_table(
      "scenario,pipeline,seed,address,status,message,wall_seconds,cpu_seconds,peak_memory_bytes,scan_seconds,result,"
      "summary_bytes,offset,bytes,sha256\nroom,iepf,7,aa,ok,,1,2,3,,bb,40,512,1024,ee\n",
      "scenario,seed,content_hash,offset,bytes,sha256\nroom,7,cc,0,512,dd\n", "shard");
  ASSERT_EQ(shard.cells.size(), 1u);
  EXPECT_EQ(shard.cells[0].result, "bb");
  EXPECT_EQ(shard.cells[0].summary_size, 40u);
  EXPECT_EQ(shard.cells[0].part.offset, 512u);
  ASSERT_NE(shard.recording("room", 7), nullptr);
  EXPECT_EQ(shard.recording("room", 7)->content_hash, "cc");
}

TEST(CellTable, NamesNoArchiveOutsideTheFolder) {
  std::string recordings = kRecordings;
  recordings.replace(recordings.find("1.a.tar"), 7, "../a.tar");
  EXPECT_THROW(parse_cell_table(cells_csv({}), recordings, "run"), ConfigError);
}

}  // namespace
}  // namespace scanbench::runs
