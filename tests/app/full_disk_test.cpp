// A disk that is full sooner or later: nothing is half written, and the same command continues when there is room.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Commands on a small file system in memory, which only their shell sees.
class FullDisk : public testing::Test {
 protected:
  void SetUp() override {
    if (in_namespace("mount -t tmpfs -o size=64k tmpfs disk").code != 0) GTEST_SKIP() << "mount is not allowed here";
  }
  Outcome in_namespace(const std::string& script) const {
    fs::create_directories(folder_ / "disk");
    fs::create_directories(folder_ / "kept");
    const std::string user = getuid() == 0 ? "" : "-Ur";
    return Child({"/bin/sh", "-c", "exec unshare " + user + " -m sh -c '" + script + "'"},
                 {{"scanbench", places::program().string()}}, folder_.path())
        .wait();
  }
  /// What a command leaves on a disk with so many kilobytes, and after it was repeated with more. `result` is kept.
  struct Trial {
    std::string first, second;  ///< exit codes
    std::string errors;         ///< of the first
  };
  Trial trial(int kilobytes, const std::string& prepare, const std::string& command, const std::string& again,
              const std::string& result) const {
    fs::remove_all(folder_ / "kept");
    const Outcome outcome =
        in_namespace("mount -t tmpfs -o size=64m tmpfs disk; cd disk; cp ../room.yaml .; " + prepare +
                     "used=$(du -sk . | cut -f1); mount -o remount,size=$((used + " + std::to_string(kilobytes) +
                     "))k .; " + command + " >/dev/null 2>../errors; echo $? >../first; mount -o remount,size=64m .; " +
                     again + " >../kept.log 2>&1; echo $? >../second; cp -r " + result +
                     " ../kept/result; find . -name \"*.tmp-*\" >../half");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(read(folder_ / "half"), "");
    return {read(folder_ / "first"), read(folder_ / "second"), read(folder_ / "errors")};
  }
  /// Every size up to what the command needs, in steps.
  void expect_continues(const std::string& prepare, const std::string& command, const std::string& again,
                        const std::string& result) {
    folder_.write("room.yaml", room());
    ASSERT_EQ(trial(60000, prepare, command, again, result).second, "0\n") << read(folder_ / "kept.log");
    const auto expected = results(folder_ / "kept/result");
    ASSERT_THAT(expected, Not(IsEmpty()));
    const int step = std::getenv("SCANBENCH_CRASH") != nullptr ? 4 : 40;
    std::vector<std::string> codes;
    for (int kilobytes = 0; codes.empty() || codes.back() != "0\n"; kilobytes += step) {
      SCOPED_TRACE(std::to_string(kilobytes) + " kB");
      ASSERT_LT(kilobytes, 4000);
      const Trial tried = trial(kilobytes, prepare, command, again, result);
      codes.push_back(tried.first);
      EXPECT_THAT(tried.first, testing::AnyOf("0\n", "2\n", "3\n", "4\n")) << tried.errors;
      if (tried.first != "0\n") {
        EXPECT_THAT(tried.errors, HasSubstr("No space left on device"));
      }
      EXPECT_EQ(tried.second, "0\n") << read(folder_ / "kept.log");
      EXPECT_THAT(differences(results(folder_ / "kept/result"), expected), IsEmpty());
      if (HasFailure()) return;
    }
    EXPECT_THAT(codes, Contains(Not("0\n"))) << "no disk was too small";
  }
  Folder folder_;
};

TEST_F(FullDisk, ARunContinues) {
  const std::string command = "$scanbench run room.yaml --seed 1,2 --out out -q";
  expect_continues("", command, command + " --resume", "out");
}

TEST_F(FullDisk, AShardContinues) {
  const std::string command = "$scanbench sweep run sweep --shard 1 -q";
  expect_continues("$scanbench sweep plan room.yaml --seed 1,2 --out sweep --shards 1 -q >/dev/null; ", command,
                   command + " && $scanbench sweep merge sweep --out merged --cells files -q", "merged");
}

TEST_F(FullDisk, AMergeIsRepeated) {
  const std::string command = "$scanbench sweep merge sweep --out merged --cells files -q";
  expect_continues(
      "$scanbench sweep plan room.yaml --seed 1,2 --out sweep --shards 1 -q >/dev/null; $scanbench sweep run sweep "
      "--shard "
      "1 "
      "-q >/dev/null; ",
      command, command, "merged");
}

}  // namespace
}  // namespace scanbench::app_test
