// Equal bytes for any number of jobs, after interruption and resume, and from effective.yaml.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

using testing::IsEmpty;

Args abcdef_run(const fs::path& out, const Args& more) {
  Args args{"run", abcdef(), "--set", "trajectory.scans=20", "--no-figures", "-q", "--out", out.string()};
  args.insert(args.end(), more.begin(), more.end());
  return args;
}

std::size_t finished_cells(const fs::path& run_folder) {
  std::size_t count = 0;
  std::error_code gone;
  for (const char* pipeline : {"sef", "lt", "iepf"})
    for (int seed = 1; seed <= 8; ++seed)
      count += fs::exists(run_folder / "cells/abcdef" / pipeline / std::to_string(seed) / "status.json", gone);
  return count;
}

TEST(Bytes, OneJobTwoJobsAndAnInterruptedRunThatIsResumedGiveTheSame) {
  const Folder folder;
  const Args seeds{"--seed", "1,2,3,4,5,6,7,8"};
  auto more = seeds;
  ASSERT_EQ(run(abcdef_run(folder / "one", more)).code, 0);
  more.insert(more.end(), {"--jobs", "2"});
  ASSERT_EQ(run(abcdef_run(folder / "two", more)).code, 0);

  Child child(command(abcdef_run(folder / "cut", seeds)), {}, {});
  ASSERT_TRUE(child.wait_until([&] { return finished_cells(folder / "cut") >= 2; }));
  child.interrupt();
  ASSERT_EQ(child.wait().code, 130);
  const std::size_t done = finished_cells(folder / "cut");
  EXPECT_GE(done, 2U);
  EXPECT_LT(done, 24U) << "the interrupt came too late to show anything";
  EXPECT_THAT(half_written(folder.path()), IsEmpty());
  more = seeds;
  more.emplace_back("--resume");
  ASSERT_EQ(run(abcdef_run(folder / "cut", more)).code, 0);

  const auto expected = results(folder / "one");
  EXPECT_EQ(expected.size(),
            8U * 6U + 24U * 4U + 5U);  // recordings; labels, lines, scans, metrics; summary, published, input
  EXPECT_THAT(differences(expected, results(folder / "two")), IsEmpty());
  EXPECT_THAT(differences(expected, results(folder / "cut")), IsEmpty());
}

// Lines instead of scans, merged.
TEST(Bytes, OfTheSpiralAreTheSameForAnyNumberOfJobsAndFromTheEffectiveScenario) {
  const Folder folder;
  const std::string spiral = places::source_dir() / "scenarios/lakaemper2009_spiral.yaml";
  const auto into = [&](const std::string& file, const std::string& out, const char* jobs) {
    return run({"run", file, "--seed", "1,2", "--only", "mean_shift_020", "--no-figures", "-q", "--jobs", jobs, "--out",
                (folder / out).string()});
  };
  ASSERT_EQ(into(spiral, "one", "1").code, 0);
  ASSERT_EQ(into(spiral, "two", "2").code, 0);
  ASSERT_EQ(into((folder / "one/effective.yaml").string(), "again", "1").code, 0);
  const auto expected = results(folder / "one");
  EXPECT_THAT(differences(expected, results(folder / "two")), IsEmpty());
  EXPECT_THAT(differences(expected, results(folder / "again")), IsEmpty());
}

TEST(Bytes, AnotherSeedGivesOtherRanges) {
  const Folder folder;
  ASSERT_EQ(run(abcdef_run(folder / "run", {"--seed", "1,2"})).code, 0);
  const fs::path recordings = folder / "run/recordings/abcdef";
  EXPECT_NE(read(recordings / "1/ranges.npy"), read(recordings / "2/ranges.npy"));
  EXPECT_EQ(read(recordings / "1/true_ranges.npy"), read(recordings / "2/true_ranges.npy"));
}

TEST(Bytes, TheEffectiveScenarioRunAgainElsewhereGivesTheSame) {
  const Folder folder;
  ASSERT_EQ(run(abcdef_run(folder / "a", {})).code, 0);
  fs::create_directories(folder / "elsewhere");
  fs::copy_file(folder / "a/effective.yaml", folder / "elsewhere/effective.yaml");
  fs::copy(folder / "a/inputs", folder / "elsewhere/inputs", fs::copy_options::recursive);
  const auto again = run({"run", "effective.yaml", "--no-figures", "-q", "--out", "b"}, {}, folder / "elsewhere");
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(differences(results(folder / "a"), results(folder / "elsewhere/b")), IsEmpty());
  EXPECT_EQ(read(folder / "a/effective.yaml"), read(folder / "elsewhere/b/effective.yaml"));
}

TEST(Bytes, ResumingAFinishedRunRunsNoCellAgain) {
  const Folder folder;
  ASSERT_EQ(run(abcdef_run(folder / "a", {})).code, 0);
  const auto before = files(folder / "a/cells");
  ASSERT_EQ(run(abcdef_run(folder / "a", {"--resume"})).code, 0);
  EXPECT_THAT(differences(before, files(folder / "a/cells")), IsEmpty());  // timing.csv too
}

}  // namespace
}  // namespace scanbench::app_test
