// Reads the fuzzers' corpus, so that faults that a fuzzer once found do not return.
#include <gtest/gtest.h>

#include "fuzz/inputs.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "tests/support/inputs.hpp"

namespace scanbench::io {
namespace {

void run_folder(const std::filesystem::path& folder, void (*run)(std::string_view)) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    EXPECT_NO_THROW(run(read_file(entry.path()))) << entry.path();
    ++count;
  }
  EXPECT_GT(count, 5) << folder;
}

TEST(FuzzCorpus, YamlIsReadOrRefused) {
  run_folder(support::source_dir() / "fuzz/corpus/yaml", fuzz::run_yaml);
}

TEST(FuzzCorpus, LogsAreReadOrRefused) {
  run_folder(support::source_dir() / "fuzz/corpus/log", fuzz::run_log);
}

TEST(FuzzCorpus, TablesOfWallsAreReadOrRefused) {
  run_folder(support::source_dir() / "fuzz/corpus/world", fuzz::run_world);
}

TEST(FuzzCorpus, WrongFilesAndShippedFilesAreReadOrRefused) {
  run_folder(support::source_dir() / "tests/harness/data/wrong", fuzz::run_yaml);
  run_folder(support::source_dir() / "scenarios/worlds", fuzz::run_yaml);
}

}  // namespace
}  // namespace scanbench::io
