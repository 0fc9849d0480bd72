// Kills at every change of a name on the disk, or at a sample of them: what was promised is still there, the same
// command continues, and nothing of the killed program is left. With SCANBENCH_CRASH=all, at all of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "harness/results/nightly/store.hpp"
#include "tests/app/killed.hpp"

namespace scanbench::app_test {
namespace {

using testing::IsEmpty;

class Crash : public testing::Test {
 protected:
  void SetUp() override {
    const Folder folder;
    if (!can_trace(folder.path())) GTEST_SKIP() << "ptrace is not allowed here";
  }
};

/// Every `step`-th change of names of the command, each in a folder of its own that `prepare` fills; `check` sees the
/// folder after the kill. Returns how many were tried.
std::size_t killed_at_each(const Args& args, std::size_t step, Exchange exchange,
                           const std::function<void(const Folder&)>& prepare,
                           const std::function<void(const Folder&)>& check) {
  if (const char* all = std::getenv("SCANBENCH_CRASH"); all != nullptr && std::string(all) == "all") step = 1;
  std::size_t tried = 0;
  for (std::size_t at = 0;; at += step, ++tried) {
    SCOPED_TRACE("killed before change " + std::to_string(at));
    const Folder folder;
    prepare(folder);
    const Killed killed = run_killed(args, folder.path(), at, exchange);
    if (!killed.killed) return tried;
    check(folder);
    if (testing::Test::HasFailure()) return tried;
  }
}

/// Copies what `make` makes, which is done once.
std::function<void(const Folder&)> copy_of(const std::function<void(const Folder&)>& make) {
  const auto made = std::make_shared<Folder>();
  make(*made);
  return [made](const Folder& folder) {
    fs::copy(made->path(), folder.path(), fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  };
}

void must(const Outcome& outcome) {
  ASSERT_EQ(outcome.code, 0) << outcome.err;
}

TEST_F(Crash, ARunOverAnOldOneLosesNeitherItNorOtherFiles) {
  const Args again{"run", "room.yaml", "--out", "out", "--no-figures", "-q"};
  const auto old_run = copy_of([&](const Folder& folder) {
    folder.write("room.yaml", room());
    must(run(again, {}, folder.path()));
    folder.write("out/notes.txt", "mine");
  });
  const auto check = [&](const Folder& folder) {
    must(run(again, {}, folder.path()));
    EXPECT_EQ(read(folder / "out/notes.txt"), "mine");
    EXPECT_THAT(half_written(folder.path()), IsEmpty());
  };
  for (const Exchange exchange : {Exchange::refused, Exchange::in_one_step})
    EXPECT_GT(killed_at_each(again, 7, exchange, old_run, check), 3u);
}

TEST_F(Crash, APlanCanBeRepeated) {
  const Args plan{"sweep", "plan", "room.yaml", "--seed", "1,2", "--out", "sweep", "--shards", "2"};
  const auto scenario = [](const Folder& folder) { folder.write("room.yaml", room()); };
  const auto check = [&](const Folder& folder) {
    must(run(plan, {}, folder.path()));
    EXPECT_THAT(half_written(folder.path()), IsEmpty());
  };
  EXPECT_GT(killed_at_each(plan, 1, Exchange::in_one_step, scenario, check), 3u);
}

/// The merged run of two shards that were not disturbed.
std::map<std::string, std::string> merged_results(const Folder& folder) {
  must(run({"sweep", "merge", "sweep", "--out", "merged", "--cells", "files"}, {}, folder.path()));
  return results(folder / "merged");
}

TEST_F(Crash, AShardCanBeRunAgain) {
  const Args shard{"sweep", "run", "sweep", "--shard", "1", "-q"};
  const auto planned = copy_of([](const Folder& folder) {
    folder.write("room.yaml", room());
    must(run({"sweep", "plan", "room.yaml", "--seed", "1,2", "--out", "sweep", "--shards", "2"}, {}, folder.path()));
    must(run({"sweep", "run", "sweep", "--shard", "2", "-q"}, {}, folder.path()));
  });
  Folder whole;
  planned(whole);
  must(run(shard, {}, whole.path()));
  const auto expected = merged_results(whole);
  const auto check = [&](const Folder& folder) {
    const Outcome status = run({"sweep", "status", "sweep"}, {}, folder.path());
    EXPECT_TRUE(status.code == 0 || status.code == 4) << status.err;
    must(run(shard, {}, folder.path()));
    EXPECT_THAT(differences(merged_results(folder), expected), IsEmpty());
  };
  EXPECT_GT(killed_at_each(shard, 2, Exchange::in_one_step, planned, check), 3u);
}

TEST_F(Crash, AMergeCanBeRepeated) {
  const auto run_shards = copy_of([](const Folder& folder) {
    folder.write("room.yaml", room());
    must(run({"sweep", "plan", "room.yaml", "--seed", "1,2", "--out", "sweep", "--shards", "2"}, {}, folder.path()));
    for (const char* shard : {"1", "2"})
      must(run({"sweep", "run", "sweep", "--shard", shard, "-q"}, {}, folder.path()));
  });
  Folder whole;
  run_shards(whole);
  const auto expected = merged_results(whole);
  const auto sweep = files(whole / "sweep");
  for (const char* cells : {"files", "archives"}) {
    const Args merge{"sweep", "merge", "sweep", "--out", "merged", "--cells", cells, "-q"};
    const auto check = [&](const Folder& folder) {
      EXPECT_THAT(differences(files(folder / "sweep"), sweep), IsEmpty());
      must(run(merge, {}, folder.path()));
      if (fs::exists(folder / "merged/archives")) must(run({"sweep", "unpack", "merged"}, {}, folder.path()));
      EXPECT_THAT(differences(results(folder / "merged"), expected), IsEmpty());
      EXPECT_THAT(half_written(folder.path()), IsEmpty());
    };
    EXPECT_GT(killed_at_each(merge, 5, Exchange::in_one_step, run_shards, check), 3u) << cells;
  }
}

TEST_F(Crash, UnpackCanBeRepeated) {
  const Args unpack{"sweep", "unpack", "merged"};
  const auto merged = copy_of([](const Folder& folder) {
    folder.write("room.yaml", room());
    must(run({"sweep", "plan", "room.yaml", "--seed", "1,2", "--out", "sweep", "--shards", "1"}, {}, folder.path()));
    must(run({"sweep", "run", "sweep", "--shard", "1", "-q"}, {}, folder.path()));
    must(run({"sweep", "merge", "sweep", "--out", "merged", "--cells", "archives"}, {}, folder.path()));
  });
  Folder whole;
  merged(whole);
  must(run(unpack, {}, whole.path()));
  const auto check = [&](const Folder& folder) {
    run(unpack, {}, folder.path());  // refused only if the killed one had finished
    EXPECT_THAT(differences(results(folder / "merged"), results(whole / "merged")), IsEmpty());
    EXPECT_FALSE(fs::exists(folder / "merged/archives"));
    EXPECT_EQ(read(folder / "merged/artefacts.sha256"), read(whole / "merged/artefacts.sha256"));
  };
  EXPECT_GT(killed_at_each(unpack, 1, Exchange::in_one_step, merged, check), 3u);
}

TEST_F(Crash, AcceptLeavesAWholeBaselineOrNone) {
  const Args accept{"night", "accept", "out", "--reason", "first", "--suite", "s"};
  const auto good_run = copy_of([](const Folder& folder) {
    folder.write("room.yaml", room());
    folder.write("suite.yaml", "schema: 1\nscenarios: [room.yaml]\ngates: {f1: 0.01}\n");
    must(run({"run", "suite.yaml", "--out", "out", "--no-figures", "-q"}, {}, folder.path()));
  });
  const auto check = [&](const Folder& folder) {
    const Outcome again = run(accept, {}, folder.path());
    EXPECT_TRUE(again.code == 0 || again.err.find("has these values already") != std::string::npos) << again.err;
    EXPECT_TRUE(fs::exists(folder / "baselines/s/0001.json"));
    EXPECT_FALSE(fs::exists(folder / "baselines/s/0002.json"));
  };
  EXPECT_GT(killed_at_each(accept, 1, Exchange::in_one_step, good_run, check), 2u);
}

TEST_F(Crash, ANightIsStoredOnce) {
  const Args night{"night", "run", "room.yaml", "--no-figures", "--store", "nights.sqlite", "--out", "run", "-q"};
  const auto second_night = copy_of([&](const Folder& folder) {
    folder.write("room.yaml", room());
    must(run(night, {}, folder.path()));
  });
  const auto check = [&](const Folder& folder) {
    must(run(night, {}, folder.path()));
    const auto nights = results::Store(folder / "nights.sqlite").nights("room");
    EXPECT_EQ(nights.size(), 2u);
    for (const auto& stored : nights) EXPECT_EQ(stored.verdict, "PASS");
    EXPECT_THAT(half_written(folder.path()), IsEmpty());
    EXPECT_FALSE(fs::exists(folder / ".run.night"));
  };
  EXPECT_GT(killed_at_each(night, 11, Exchange::in_one_step, second_night, check), 3u);
}

}  // namespace
}  // namespace scanbench::app_test
