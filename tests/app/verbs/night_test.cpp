// The verbs of `night`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "harness/results/nightly/store.hpp"
#include "tests/app/browser.hpp"
#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

/// A folder with a suite of one room, two pipelines and four seeds.
class Nightly : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("room.yaml",
                  room_with("metrics:", "  - {name: lt, extract: {module: line_tracking, params: {}}}\nmetrics:"));
    folder_.write(
        "suite.yaml",
        "schema: 1\nscenarios: [room.yaml]\nseeds: {first: 1, count: 4}\ngates: {f1: 0.005, sigma_offset: 0.001}\n");
  }
  Outcome here(const Args& args) const { return run(args, {}, folder_.path()); }
  Outcome night(const Args& more = {}) const {
    Args args{"night", "run", "suite.yaml", "--no-figures"};
    args.insert(args.end(), more.begin(), more.end());
    if (std::ranges::find(more, "--store") == more.end()) args.insert(args.end(), {"--store", "nights.sqlite"});
    return here(args);
  }
  /// A night whose room has a threshold of iepf that rounds off every corner.
  Outcome worse_night(const Args& more = {}) const {
    const std::string good = read(folder_ / "room.yaml");
    std::string bad = good;
    const std::string threshold = "threshold_m: 0.10";
    folder_.write("room.yaml", bad.replace(bad.find(threshold), threshold.size(), "threshold_m: 2"));
    const Outcome outcome = night(more);
    folder_.write("room.yaml", good);
    return outcome;
  }
  std::string page() const { return read(folder_ / "out/nightly/suite/nightly.html"); }

  Folder folder_;
};

TEST_F(Nightly, FailsWhenAParameterMakesAGateWorseAndPassesWhenItIsRestored) {
  const Outcome first = night();
  EXPECT_EQ(first.code, 0) << first.err;
  EXPECT_THAT(first.out, HasSubstr("PASS: this is the first night of the suite"));
  ASSERT_EQ(here({"night", "accept", "out/nightly/suite", "--reason", "first"}).code, 0);
  const Outcome worse = worse_night();
  EXPECT_EQ(worse.code, 1) << worse.err;
  EXPECT_THAT(worse.out, AllOf(HasSubstr("FAIL: "), HasSubstr(" of iepf in room "), HasSubstr("95 % interval"),
                               HasSubstr("over 4 seeds")));
  EXPECT_THAT(worse.out, HasSubstr("4 of 8 cells were not run again"));  // those of lt
  const std::string html = page();
  EXPECT_THAT(html, HasSubstr("baseline 0001"));
  EXPECT_THAT(html, HasSubstr("threshold_m: 0.1 → 2"));
  EXPECT_THAT(html, AllOf(HasSubstr("iepf in room, seed "), HasSubstr("before ("), HasSubstr("now: ")));
  EXPECT_THAT(html, Not(HasSubstr("http")));  // self-contained
  const Outcome restored = night();
  EXPECT_EQ(restored.code, 0) << restored.out;
  EXPECT_THAT(restored.out, HasSubstr("PASS: none of 4 gates is worse (4 equal to the bit)."));
  EXPECT_THAT(page(),
              AllOf(HasSubstr("PASS: none of 4 gates is worse.</p>"), HasSubstr("<p>Gates: 4 equal to the bit.</p>")));
  EXPECT_THAT(here({"night", "accept", "out/nightly/suite", "--reason", "again"}).err,
              HasSubstr("has these values already"));
}

TEST_F(Nightly, KeepsTheNameOfItsSuiteInAnyFolder) {
  ASSERT_EQ(night({"--out", "elsewhere"}).code, 0);
  const Outcome accepted = here({"night", "accept", "elsewhere", "--reason", "first"});
  EXPECT_THAT(accepted.out, HasSubstr("baselines/suite/0001.json")) << accepted.err;
  ASSERT_EQ(night({"--out", "elsewhere"}).code, 0);
  EXPECT_THAT(read(folder_ / "elsewhere/nightly.html"), HasSubstr("baseline 0001"));
}

TEST_F(Nightly, ShowsTheScanOfTheLastGoodNightThatIsInAnotherFolder) {
  ASSERT_EQ(night({"--out", "first"}).code, 0);
  ASSERT_EQ(worse_night({"--out", "second"}).code, 1);
  EXPECT_THAT(read(folder_ / "second/nightly.html"), AllOf(HasSubstr(" UTC): "), HasSubstr("now: ")));
}

TEST_F(Nightly, WithoutAReferenceLeavesNoComparisonOfAnEarlierNight) {
  ASSERT_EQ(night().code, 0);
  ASSERT_EQ(worse_night().code, 1);
  ASSERT_TRUE(fs::exists(folder_ / "out/nightly/suite/comparison.md"));
  ASSERT_EQ(night({"--store", "other.sqlite"}).code, 0);
  for (const char* file : {"comparison.md", "comparison.json", "comparison.junit.xml"})
    EXPECT_FALSE(fs::exists(folder_ / "out/nightly/suite" / file)) << file;
}

TEST_F(Nightly, RefusesAFolderOfBaselinesThatIsNotThere) {
  const Outcome outcome = night({"--baselines", "baselinse"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--baselines: there is no folder baselinse"));
}

TEST_F(Nightly, AfterABadFirstNightSaysThatThereIsNoReference) {
  const std::string good = room_with("metrics:", "  - {name: hang, extract: {module: iepf}}\nmetrics:");
  folder_.write("room.yaml", good + "limits: {seconds: 0.000001}\n");
  const Outcome first = night();
  folder_.write("room.yaml", good);
  EXPECT_EQ(first.code, 1) << first.out;
  EXPECT_THAT(first.out, HasSubstr("cells are not ok, first room/"));
  const Outcome second = night();
  EXPECT_EQ(second.code, 0) << second.out;
  EXPECT_THAT(second.out, HasSubstr("no earlier night of the suite was good and there is no baseline"));
}

TEST_F(Nightly, WithoutABaselineIsComparedWithTheLastGoodNight) {
  ASSERT_EQ(night().code, 0);
  EXPECT_EQ(worse_night().code, 1);
  EXPECT_EQ(worse_night().code, 1);  // a bad night is not a reference
  EXPECT_EQ(night().code, 0);
}

TEST_F(Nightly, WithOverridesIsJudgedAndMarkedAndNoOtherNightIsComparedWithIt) {
  ASSERT_EQ(night().code, 0);
  const Args same{"--set", "pipelines.iepf.extract.params.threshold_m=0.1"};  // the value of the file: all is equal
  const Outcome marked = night(same);
  EXPECT_EQ(marked.code, 0) << marked.out;
  EXPECT_THAT(page(), HasSubstr("This night ran with --set pipelines.iepf.extract.params.threshold_m=0.1. It is in no "
                                "trend, and no later night is compared with it."));
  const results::Store store(folder_ / "nights.sqlite");
  const auto nights = store.nights("suite");
  ASSERT_EQ(nights.size(), 2U);
  EXPECT_EQ(nights[0].overrides, "");
  EXPECT_EQ(nights[1].overrides, "pipelines.iepf.extract.params.threshold_m=0.1");
  EXPECT_EQ(store.trend("suite", "room", "iepf", "f1", 30).size(), 1U);
  const Outcome third = night();
  EXPECT_THAT(page(), AllOf(HasSubstr("Compared with the last good night, " + nights[0].start),
                            HasSubstr("with --set pipelines.iepf.extract.params.threshold_m=0.1: PASS"),
                            Not(HasSubstr("This night ran with --set"))));
}

TEST_F(Nightly, KilledInItsMiddleAndStartedAgainEqualsAnUnbrokenOne) {
  ASSERT_EQ(night({"--out", "whole", "--store", "whole.sqlite"}).code, 0);
  {
    const Child child(
        command({"night", "run", "suite.yaml", "--store", "broken.sqlite", "--no-figures", "--out", "broken"}), {},
        folder_.path());
    child.wait_until([&] {
      return fs::exists(folder_ / "broken/cells/room/iepf/2/status.json") ||
             fs::exists(folder_ / ".broken.new/cells/room/iepf/2/status.json");
    });
    child.interrupt(SIGKILL);
  }
  ASSERT_EQ(night({"--out", "broken", "--store", "broken.sqlite"}).code, 0);
  const auto summary = [&](const char* run) {  // without the times
    std::string kept;
    std::istringstream lines(read(folder_ / run / "summary.csv"));
    for (std::string line; std::getline(lines, line);)
      if (line.find(",t_") == std::string::npos) kept += line + "\n";
    return kept;
  };
  EXPECT_EQ(summary("whole"), summary("broken"));
  const auto rows = [&](const char* file) {
    const results::Store store(folder_ / file);
    const auto nights = store.nights("suite");
    EXPECT_EQ(nights.size(), 1U);
    std::map<std::string, double> values;
    for (const auto& cell : store.load(nights.front().id).cells)
      for (const auto& row : cell.rows)
        if (!row.metric.starts_with("t_"))
          values[to_string(cell.key) + "/" + row.metric + "/" + row.subject] = row.value;
    return values;
  };
  const auto whole = rows("whole.sqlite");
  EXPECT_GT(whole.size(), 50U);
  EXPECT_THAT(whole, testing::ContainerEq(rows("broken.sqlite")));
}

TEST_F(Nightly, InterruptedSaysThatTheSameCommandContinues) {
  Child child(command({"night", "run", "suite.yaml", "--store", "n.sqlite", "--no-figures", "--out", "night"}), {},
              folder_.path());
  ASSERT_TRUE(child.wait_until([&] {
    return fs::exists(folder_ / "night/cells/room/iepf/1/status.json") ||
           fs::exists(folder_ / ".night.new/cells/room/iepf/1/status.json");
  }));
  child.interrupt();
  const Outcome outcome = child.wait();
  EXPECT_EQ(outcome.code, 130);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("the same command continues"), Not(HasSubstr("--resume"))));
}

TEST_F(Nightly, StoreIsMadeAgainFromRunFolders) {
  ASSERT_EQ(night().code, 0);
  const Outcome made = here({"night", "store", "again.sqlite", "out/nightly/suite"});
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("8 cells"));
  const results::Store again(folder_ / "again.sqlite");
  ASSERT_EQ(again.nights("suite").size(), 1U);
  EXPECT_EQ(again.load(again.nights("suite").front().id).cells.size(), 8U);
}

TEST_F(Nightly, SaysBeforeTheNightWhatCannotBeUsed) {
  folder_.write("text.sqlite", "no database, only text, and enough of it to be looked at\n");
  const Outcome text = night({"--store", "text.sqlite"});
  EXPECT_EQ(text.code, 2);
  EXPECT_THAT(text.err, HasSubstr("text.sqlite: not a store of scanbench"));
  const Outcome baseline = night({"--baseline", "0007"});
  EXPECT_EQ(baseline.code, 2);
  EXPECT_THAT(baseline.err, HasSubstr("baselines has no baseline '0007' of suite; known: none"));
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  folder_.write("suite.yaml", "schema: 1\nscenarios: [room.yaml]\ngates: {f2: 0.1}\n");
  EXPECT_THAT(night().err, AllOf(HasSubstr("suite.yaml:3:9: there is no metric f2"), HasSubstr("did you mean 'f1'?")));
  folder_.write("suite.yaml", "schema: 1\nscenarios: [room.yaml]\ngates: {f1: -1}\n");
  EXPECT_THAT(night().err, HasSubstr("suite.yaml:3:13: the tolerance of f1 is -1; allowed: >= 0"));
  folder_.write("suite.yaml", "schema: 1\nscenarios: [room.yaml]\ngates: {n_true: 1}\n");
  EXPECT_THAT(night().err, HasSubstr("suite.yaml:3:9: no value of n_true is better than another"));
}

TEST_F(Nightly, NamesAnOptionThatIsMisspeltAndAFileThatIsNotWhatItSays) {
  const Outcome misspelt = here({"night", "run", "suite.yaml", "--sotre", "nights.sqlite"});
  EXPECT_EQ(misspelt.code, 2);
  EXPECT_THAT(misspelt.err, AllOf(HasSubstr("no option '--sotre'"), HasSubstr("did you mean '--store'?")));
  folder_.write("second.yaml", room());
  const Outcome two = here({"night", "run", "room.yaml", "second.yaml", "--store", "nights.sqlite"});
  EXPECT_EQ(two.code, 2);
  EXPECT_THAT(two.err, HasSubstr("2 files have no common name; --suite must name the suite"));
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  ASSERT_EQ(night().code, 0);
  folder_.write("out/nightly/suite/night.json", "{}");
  const Outcome damaged = here({"night", "accept", "out/nightly/suite", "--reason", "first"});
  EXPECT_EQ(damaged.code, 2);
  EXPECT_THAT(damaged.err, HasSubstr("night.json: the key 'suite' is missing"));
}

TEST_F(Nightly, TakesTheNumberOfABaselineWithoutItsZeros) {
  ASSERT_EQ(night().code, 0);
  ASSERT_EQ(here({"night", "accept", "out/nightly/suite", "--reason", "first"}).code, 0);
  EXPECT_EQ(night({"--baseline", "1"}).code, 0);
  EXPECT_THAT(page(), HasSubstr("baseline 0001"));
  EXPECT_THAT(night({"--baseline", "2"}).err, HasSubstr("no baseline '2' of suite; known: 0001"));
}

TEST_F(Nightly, SaysHowManyCellsItTookFromTheLastNightOnlyIfItTookAny) {
  EXPECT_THAT(night().out, HasSubstr("8 cells, all run in this night."));
  EXPECT_THAT(night().out, HasSubstr("8 of 8 cells were not run again"));
}

TEST_F(Nightly, OfTwoAtOnceOnANewStoreBothAreKept) {
  Child first(command({"night", "run", "suite.yaml", "--no-figures", "--store", "both.sqlite", "--out", "one"}), {},
              folder_.path());
  EXPECT_EQ(night({"--store", "both.sqlite", "--out", "two"}).code, 0);
  EXPECT_EQ(first.wait().code, 0);
  EXPECT_EQ(results::Store(folder_ / "both.sqlite").nights("suite").size(), 2U);
}

TEST_F(Nightly, ComparesALogByItsScansWithTheLastGoodNightAndByValueWithABaseline) {
  std::string log;
  for (int scan = 0; scan < 40; ++scan) {
    log += std::to_string(scan);
    for (int beam = 0; beam < 60; ++beam) log += "," + std::to_string(2.0 + 0.02 * ((beam * 7 + scan * 3) % 11));
    log += "\n";
  }
  folder_.write("log.csv", log);
  folder_.write("log.yaml",
                "schema: 1\nabout: a log\nrecording: {log: log.csv, format: csv, columns: [t_s, ranges], beams: 60, "
                "first_angle_deg: -60, step_deg: 2}\nseed: 1\npipelines:\n  - {name: iepf, extract: {module: iepf, "
                "params: {threshold_m: 0.1}}}\nmetrics: [siadat1997]\n");
  folder_.write("suite.yaml", "schema: 1\nscenarios: [log.yaml]\ngates: {d_mean: 0.0001}\n");
  ASSERT_EQ(night().code, 0);
  const auto worse_log = [&] {
    const std::string good = read(folder_ / "log.yaml");
    std::string bad = good;
    folder_.write("log.yaml", bad.replace(bad.find("threshold_m: 0.1"), 16, "threshold_m: 0.6"));
    const Outcome outcome = night();
    folder_.write("log.yaml", good);
    return outcome;
  };
  const Outcome worse = worse_log();
  EXPECT_EQ(worse.code, 1) << worse.out << worse.err;
  EXPECT_THAT(worse.out, HasSubstr("over 40 scans in blocks of"));
  EXPECT_THAT(page(), AllOf(HasSubstr("per-scan pairs: 40 scans in blocks of"), HasSubstr("40 scans")));
  ASSERT_EQ(night().code, 0);
  ASSERT_EQ(here({"night", "accept", "out/nightly/suite", "--reason", "first"}).code, 0);
  const Outcome by_value = worse_log();
  EXPECT_EQ(by_value.code, 1) << by_value.out;
  EXPECT_THAT(by_value.out, HasSubstr("without an interval: baseline 0001 keeps no single scans"));
  EXPECT_THAT(page(), HasSubstr("value only"));
}

TEST_F(Nightly, IsIncompleteWhereAScenarioIsGone) {
  folder_.write("second.yaml", room());
  folder_.write("suite.yaml", "schema: 1\nscenarios: [room.yaml, second.yaml]\ngates: {f1: 0.005}\n");
  ASSERT_EQ(night().code, 0);
  folder_.write("suite.yaml", "schema: 1\nscenarios: [room.yaml]\ngates: {f1: 0.005}\n");
  const Outcome less = night({"--out", "less"});
  EXPECT_EQ(less.code, 4) << less.out;
  EXPECT_THAT(less.out, HasSubstr("INCOMPLETE: 1 cell is missing, first second/iepf/1."));
}

TEST_F(Nightly, PageSortsFollowsItsLinksAndRequestsNothing) {
  if (!has_browser()) GTEST_SKIP() << "chromium is not installed";
  ASSERT_EQ(night().code, 0);
  ASSERT_EQ(worse_night().code, 1);
  const fs::path html = folder_ / "out/nightly/suite/nightly.html";
  // The first table with a metric column: click its heading twice; the rows are then in both orders.
  const std::string sorted = title_after(html, R"js(
    const table = [...document.querySelectorAll('table')].find(t => t.tHead && t.tBodies[0].rows.length > 2);
    const heads = table.tHead.rows[table.tHead.rows.length - 1].cells;
    const column = () => [...table.tBodies[0].rows].map(r => r.cells[2].textContent);
    heads[2].click(); const down = column(); heads[2].click(); const up = column();
    document.title = String(up.join() === [...up].sort((a, b) => a.localeCompare(b)).join()) + ' ' +
        String(down.join() === [...up].reverse().join() || down[0] >= down[down.length - 1]) + ' ' + heads[2].getAttribute('aria-sort');
  )js",
                                         folder_);
  EXPECT_EQ(sorted, "true true ascending");
  EXPECT_EQ(title_after(html, R"js(
    const links = [...document.querySelectorAll('nav a')];
    links[0].click();
    document.title = location.hash + ' ' + links.every(a => document.querySelector(a.getAttribute('href'))) + ' ' +
        performance.getEntriesByType('resource').filter(r => !r.name.startsWith('data:')).length;
  )js",
                        folder_),
            "#worse-section true 0");
}

}  // namespace
}  // namespace scanbench::app_test
