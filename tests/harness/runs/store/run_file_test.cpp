// Which files of a folder belong to a run.
#include "harness/runs/store/run_file.hpp"

#include <gtest/gtest.h>

#include "harness/runs/store/cell_files.hpp"
#include "harness/runs/store/manifest.hpp"

namespace scanbench::runs {
namespace {

TEST(RunFile, IsNamedByItsLastPart) {
  EXPECT_EQ(kStatusFile.name(), "status.json");
  EXPECT_EQ(std::filesystem::path("a/b") / kManifestFile, std::filesystem::path("a/b/manifest.json"));
}

TEST(RunFile, IsKnownWhereItsWriterPutsIt) {
  for (const char* path : {"manifest.json", "summary.csv", "effective.yaml", "scenarios/a b.yaml", "benchmark.json",
                           "cells/s/p/1/status.json", "cells/s.x/p=1/20/lines.csv", "recordings/s/1/scan.json",
                           "inputs/s/published.csv", "inputs/s/sources.json"})
    EXPECT_TRUE(is_run_file(path)) << path;
}

TEST(RunFile, IsNotTakenForAnothersFile) {
  for (const char* path :
       {"", "notes.txt", "manifest.json.bak", "x/manifest.json", "cells/s/p/status.json", "cells/s/p/1/x/status.json",
        "cells/s/p/1/notes.csv", "cells/s/p/1/lines.csv/x", "recordings/s/scan.json", "scenarios/a.yml", "Summary.csv"})
    EXPECT_FALSE(is_run_file(path)) << path;
}

TEST(RunFile, IsATableOfAMetricFamilyInACellOnly) {
  const auto tables = metric_table_files();
  ASSERT_FALSE(tables.empty());
  for (const auto& table : tables) {
    EXPECT_TRUE(is_run_file("cells/s/p/1/" + table)) << table;
    EXPECT_FALSE(is_run_file("figures/" + table)) << table;
  }
}

TEST(RunFolder, HoldsFilesOfARun) {
  for (const char* path : {"cells", "cells/s", "cells/s/p", "cells/s/p/1", "recordings/s/1", "effective"})
    EXPECT_TRUE(holds_run_files(path)) << path;
  for (const char* path : {"", "notes", "cells/s/p/1/x", "recordings/s/1/x", "manifest.json"})
    EXPECT_FALSE(holds_run_files(path)) << path;
}

}  // namespace
}  // namespace scanbench::runs
