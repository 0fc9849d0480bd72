// Damaged runs, sweeps, stores and protocol frames: every verb says what is wrong, and none crashes, hangs or writes
// elsewhere. Each test takes some seconds; SCANBENCH_MUTATIONS is the number of trials instead.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/app/mutation.hpp"

namespace scanbench::app_test {
namespace {

using testing::IsEmpty;

constexpr std::chrono::seconds kTime(10);         // for the trials of one test
constexpr std::chrono::seconds kLongestCall(30);  // of one verb on a small run

class Mutations : public testing::Test {
 protected:
  void SetUp() override {
    good_.write("room.yaml", room());
    good_.write("sentinel/other.txt", "not of the run");
  }
  void must(const Args& args) const {
    const Outcome outcome = run(args, {}, good_.path());
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  /// Damages one file below `part` of a copy of what was prepared, then calls one of the verbs, trial by trial.
  void expect_refusals(const std::string& part, const std::vector<Args>& verbs) const {
    int trials = 0;
    for (const auto begun = std::chrono::steady_clock::now(); goes_on(trials, begun) && !HasFailure(); ++trials) {
      Mutator mutator(static_cast<std::uint64_t>(trials));
      const Folder folder;
      fs::copy(good_.path(), folder.path(), fs::copy_options::recursive | fs::copy_options::overwrite_existing);
      std::string done = mutator.mutate_one(folder / part);
      if (mutator.below(3) == 0) done += ", " + mutator.mutate_one(folder / part);
      const Args& verb = verbs.at(mutator.below(verbs.size()));
      SCOPED_TRACE("trial " + std::to_string(trials) + ": " + done + ", then " + verb[0]);
      expect_answer(verb, folder);
    }
    RecordProperty("trials", trials);
  }

  static bool goes_on(int trials, std::chrono::steady_clock::time_point begun) {
    const char* wanted = std::getenv("SCANBENCH_MUTATIONS");
    return wanted == nullptr ? std::chrono::steady_clock::now() - begun < kTime : trials < std::atoi(wanted);
  }

  static void expect_answer(const Args& verb, const Folder& folder) {
    const auto begun = std::chrono::steady_clock::now();
    const Outcome outcome = run(verb, {}, folder.path());
    EXPECT_LE(outcome.code, 5) << outcome.err;  // not a signal, and not 70
    EXPECT_TRUE(outcome.code == 0 || !outcome.err.empty() || !outcome.out.empty()) << "refused without a word";
    EXPECT_LT(std::chrono::steady_clock::now() - begun, kLongestCall);
    EXPECT_EQ(read(folder / "sentinel/other.txt"), "not of the run");
  }

  Folder good_;
};

TEST_F(Mutations, OfARunAreRefused) {
  must({"run", "room.yaml", "--out", "out", "-q"});
  must({"run", "room.yaml", "--out", "good", "-q", "--no-figures"});
  expect_refusals("out", {{"report", "out"},
                          {"compare", "out", "good"},
                          {"compare", "good", "out"},
                          {"figures", "out", "-q"},
                          {"score", "out", "-q"},
                          {"export", "out", "--out", "logs"},
                          {"night", "accept", "out", "--reason", "r", "--suite", "s"},
                          {"run", "room.yaml", "--out", "out", "--resume", "-q", "--no-figures"}});
}

TEST_F(Mutations, OfASweepAreRefused) {
  must({"sweep", "plan", "room.yaml", "--seed", "1,2", "--out", "sweep", "--shards", "2"});
  must({"sweep", "run", "sweep", "--shard", "1", "-q"});
  must({"sweep", "run", "sweep", "--shard", "2", "-q"});
  expect_refusals("sweep", {{"sweep", "status", "sweep"},
                            {"sweep", "merge", "sweep", "--out", "merged", "-q"},
                            {"sweep", "merge", "sweep", "--out", "merged", "--cells", "archives", "-q"},
                            {"sweep", "run", "sweep", "--shard", "1", "-q"}});
}

TEST_F(Mutations, OfAnArchivedRunAreRefused) {
  must({"sweep", "plan", "room.yaml", "--seed", "1,2", "--out", "sweep", "--shards", "1"});
  must({"sweep", "run", "sweep", "--shard", "1", "-q"});
  must({"sweep", "merge", "sweep", "--out", "merged", "--cells", "archives", "-q"});
  expect_refusals("merged", {{"report", "merged"},
                             {"sweep", "unpack", "merged"},
                             {"compare", "merged", "merged"},
                             {"show", "merged", "--frame", "0", "--seed", "1", "--out", "scan.svg"}});
}

TEST_F(Mutations, OfAStoreOfNightsAreRefused) {
  fs::create_directory(good_ / "nights");
  must({"night", "run", "room.yaml", "--no-figures", "--store", "nights/n.sqlite", "--out", "night", "-q"});
  must({"night", "run", "room.yaml", "--no-figures", "--store", "nights/n.sqlite", "--out", "night", "-q"});
  expect_refusals("nights",
                  {{"night", "run", "room.yaml", "--no-figures", "--store", "nights/n.sqlite", "--out", "night", "-q"},
                   {"night", "store", "nights/n.sqlite", "night"}});
}

TEST_F(Mutations, OfTheFramesOfAProgramSpoilOnlyItsOwnCell) {
  if (std::system("python3 -c pass >/dev/null 2>&1") != 0) GTEST_SKIP() << "there is no python3";
  const std::string program = (places::source_dir() / "tests/plugins/mutates.py").string();
  int trials = 0;
  constexpr int kAtOnce = 8;
  for (const auto begun = std::chrono::steady_clock::now(); goes_on(trials, begun) && !HasFailure();
       trials += kAtOnce) {
    std::string pipelines;
    for (int i = trials; i < trials + kAtOnce; ++i)
      pipelines += "  - {name: m" + std::to_string(i) + ", extract: {program: [python3, '" + program + "', '" +
                   std::to_string(i) + "'], scan_seconds: 0.2}}\n";
    good_.write("room.yaml", room_with("metrics:", pipelines + "metrics:"));
    const Folder folder;
    const Outcome outcome =
        run({"run", (good_ / "room.yaml").string(), "--out", "out", "-q", "--no-figures"}, {}, folder.path());
    EXPECT_TRUE(outcome.code == 0 || outcome.code == 3) << "from trial " << trials << ": " << outcome.err;
    const auto status = nlohmann::json::parse(read(folder / "out/cells/room/iepf/1/status.json"), nullptr, false);
    EXPECT_EQ(status.value("status", ""), "ok");
    for (int i = trials; i < trials + kAtOnce; ++i) {
      const std::string text = read(folder / "out/cells/room" / ("m" + std::to_string(i)) / "1/status.json");
      EXPECT_FALSE(nlohmann::json::parse(text, nullptr, false).is_discarded()) << "trial " << i << ": " << text;
    }
  }
  RecordProperty("trials", trials);
}

}  // namespace
}  // namespace scanbench::app_test
