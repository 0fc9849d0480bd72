// Every verb on good input.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A folder with room.yaml and its run in "run".
class Verbs : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("room.yaml", room());
    const auto outcome = here({"run", "room.yaml", "--out", "run", "-q"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "");
  }
  Outcome here(const Args& args, const Env& env = {}) const { return run(args, env, folder_.path()); }
  Folder folder_;
};

TEST(Catalog, ListsEveryKindAndDescribesEveryName) {
  const auto all = run({"list", "--json"});
  ASSERT_EQ(all.code, 0);
  std::set<std::string> kinds;
  for (const auto& entry : nlohmann::json::parse(all.out)) kinds.insert(entry.at("kind").get<std::string>());
  EXPECT_THAT(kinds, testing::IsSupersetOf({"extract", "merge", "metrics", "figure", "trajectory", "sensor"}));
  for (const auto& kind : kinds) {
    const auto one = nlohmann::json::parse(run({"list", kind, "--json"}).out);
    EXPECT_FALSE(one.empty());
    for (const auto& entry : one) EXPECT_EQ(entry.at("kind"), kind);
  }
  const auto iepf = run({"describe", "iepf"});
  EXPECT_EQ(iepf.code, 0);
  EXPECT_THAT(iepf.out, AllOf(HasSubstr("threshold_m"), HasSubstr("Siadat")));
  const auto near = run({"describe", "iefp"});
  EXPECT_EQ(near.code, 2);
  EXPECT_THAT(near.err, HasSubstr("did you mean 'iepf'?"));
  EXPECT_EQ(run({"list", "furniture"}).code, 2);
  EXPECT_EQ(run({"--version"}).code, 0);
  EXPECT_THAT(run({"--help"}).out, HasSubstr("compare"));
}

TEST(Catalog, TakesPluralsModulesAndSingleMetrics) {
  EXPECT_EQ(run({"list", "sensors"}).out, run({"list", "sensor"}).out);
  EXPECT_EQ(run({"list", "metric"}).out, run({"list", "metrics"}).out);
  EXPECT_THAT(run({"list", "trajectories"}).out, HasSubstr("waypoints"));
  const auto modules = run({"list", "modules"});
  EXPECT_EQ(modules.code, 0);
  EXPECT_THAT(modules.out, AllOf(HasSubstr("iepf"), HasSubstr("mean_shift"), Not(HasSubstr("sick_lms200"))));
  const auto f1 = run({"describe", "f1"});
  EXPECT_EQ(f1.code, 0) << f1.err;
  EXPECT_THAT(f1.out, AllOf(HasSubstr("harmonic mean"), HasSubstr("segments"), HasSubstr("higher is better")));
  EXPECT_THAT(run({"describe", "nees"}).out, HasSubstr("best near 2"));
  EXPECT_THAT(run({"describe", "recal"}).err, HasSubstr("did you mean 'recall'?"));
  EXPECT_THAT(run({"--help"}).out, AllOf(HasSubstr("./scanbench test"), HasSubstr("./scanbench build")));
}

TEST(Check, FindsEveryScenarioOfTheTreeGood) {
  for (const auto& entry : fs::directory_iterator(places::source_dir() / "scenarios")) {
    if (entry.path().extension() != ".yaml") continue;
    const auto outcome = run({"check", entry.path().string()});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr(": good: "));
  }
}

TEST_F(Verbs, CheckPrintsTheEffectiveScenarioOfTheRun) {
  EXPECT_EQ(here({"check", "room.yaml", "--effective"}).out, read(folder_ / "run/effective.yaml"));
  EXPECT_EQ(here({"check", "run/effective.yaml", "--effective"}).out, read(folder_ / "run/effective.yaml"));
}

TEST_F(Verbs, SimulateMakesTheRecordingOfTheRun) {
  ASSERT_EQ(here({"simulate", "room.yaml", "--out", "recordings only"}).code, 0);
  EXPECT_THAT(differences(files(folder_ / "run/recordings"), files(folder_ / "recordings only/recordings")), IsEmpty());
}

TEST_F(Verbs, ScoreFiguresAndReportGiveTheBytesOfTheRun) {
  const auto before = files(folder_ / "run");
  fs::remove(folder_ / "run/summary.csv");
  fs::remove(folder_ / "run/cells/room/iepf/1/metrics.csv");
  EXPECT_EQ(here({"score", "run"}).code, 0);
  fs::remove_all(folder_ / "run/figures");
  EXPECT_EQ(here({"figures", "run"}).code, 0);
  fs::remove(folder_ / "run/report.md");
  fs::remove(folder_ / "run/report.html");
  EXPECT_EQ(here({"report", "run"}).code, 0);
  auto changed = differences(before, files(folder_ / "run"));
  std::erase(changed, "manifest.json");
  EXPECT_THAT(changed, IsEmpty());
}

TEST_F(Verbs, CompareIsGoodWithItselfAndFailsWithAWorseOne) {
  const auto same = here({"compare", "run", "run"});
  EXPECT_EQ(same.code, 0);
  EXPECT_THAT(same.out, AllOf(HasSubstr(" same"), Not(HasSubstr("worse"))));
  // A threshold of two metres rounds off every corner, so walls are not found.
  ASSERT_EQ(here({"run", "room.yaml", "-q", "--no-figures", "--out", "worse", "--set",
                  "pipelines.iepf.extract.params.threshold_m=2"})
                .code,
            0);
  const auto worse = here({"compare", "run", "worse", "--csv", "rows.csv"});
  EXPECT_EQ(worse.code, 1) << worse.out << worse.err;
  EXPECT_THAT(worse.out, HasSubstr("worse"));
  EXPECT_THAT(read(folder_ / "rows.csv"), HasSubstr("precision"));
}

TEST_F(Verbs, AnExportedLogReadsBackToTheSameRangesAndLines) {
  const std::string head = "schema: 1\nrecording: {log: run/export/room_1.";
  const std::string tail = "}\nsensor: {preset: sick_lms200}\n" + room().substr(room().find("pipelines:"));
  const std::string rest = tail.substr(0, tail.find("metrics:")) + "metrics: [siadat1997]\n";
  for (const std::string format : {"carmen", "csv"}) {
    const auto exported = here({"export", "run", "--format", format});
    ASSERT_EQ(exported.code, 0) << exported.err;
    std::string options = (format == "carmen" ? "log" : "csv") + std::string(", format: ") + format;
    std::istringstream lines(exported.out);  // "  key: value" lines: what reads the log back
    for (std::string line; std::getline(lines, line);) {
      const auto colon = line.find(": ");
      if (!line.starts_with("  ") || colon == std::string::npos) continue;
      const std::string key = line.substr(2, colon - 2);
      const std::string value = line.substr(colon + 2);
      options += ", " + key + ": " + (key == "columns" ? "[" + value + "]" : value);
    }
    folder_.write("again.yaml", head + options + rest);
    const auto again = here({"run", "again.yaml", "-q", "--out", "again_" + format});
    ASSERT_EQ(again.code, 0) << again.err << read(folder_ / "again.yaml");
    const fs::path second = folder_ / ("again_" + format);
    EXPECT_EQ(read(second / "recordings/again/1/ranges.npy"), read(folder_ / "run/recordings/room/1/ranges.npy"));
    EXPECT_EQ(read(second / "cells/again/iepf/1/lines.csv"), read(folder_ / "run/cells/room/iepf/1/lines.csv"));
  }
  ASSERT_EQ(here({"export", "run", "--format", "tum", "--out", "poses"}).code, 0);
  std::istringstream poses(read(folder_ / "poses/room_1.txt"));
  int rows = 0;
  for (std::string line; std::getline(poses, line);) rows += !line.empty() && line.front() != '#';
  EXPECT_EQ(rows, 5);
}

TEST_F(Verbs, FiguresSaysWhenThereIsNothingToDraw) {
  folder_.write("plain.yaml", room_with("figures: [environment]\n", ""));
  ASSERT_EQ(here({"run", "plain.yaml", "--out", "plain", "-q"}).code, 0);
  const auto outcome = here({"figures", "plain"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("nothing to draw: the scenarios name no figures"));
  EXPECT_THAT(here({"figures", "run"}).out, AllOf(HasSubstr(".svg"), Not(HasSubstr("nothing"))));
}

TEST_F(Verbs, ASelectionOfCellsIsNoFailureAndComparesAsComplete) {
  folder_.write("two.yaml", room_with("metrics:", "  - {name: other, extract: {module: sef}}\nmetrics:"));
  for (const char* out : {"one", "again"})
    ASSERT_EQ(here({"run", "two.yaml", "--out", out, "--only", "iepf", "-q", "--no-figures"}).code, 0);
  EXPECT_THAT(read(folder_ / "one/report.md"), AllOf(HasSubstr("1 of 2 cells selected, all ok"),
                                                     Not(HasSubstr("that are not ok")), Not(HasSubstr("other"))));
  const auto same = here({"compare", "one", "again"});
  EXPECT_EQ(same.code, 0) << same.out;
  EXPECT_THAT(same.out, Not(HasSubstr("INCOMPLETE")));
}

TEST_F(Verbs, ProgressIntoAFileIsALineEveryTenthOfTheWork) {
  const auto outcome = here({"run", "room.yaml", "--out", "many", "--no-figures", "--seed",
                             "1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20,21,22,23,24,25"});
  EXPECT_EQ(outcome.code, 0);
  const auto lines = std::count(outcome.err.begin(), outcome.err.end(), '\n');
  EXPECT_GE(lines, 5) << outcome.err;
  EXPECT_LE(lines, 12) << outcome.err;
}

TEST_F(Verbs, ScoreOfARunWithAMissingCellIsIncomplete) {
  fs::remove_all(folder_ / "run/cells/room/iepf");
  const auto outcome = here({"score", "run"});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_THAT(outcome.out, HasSubstr("INCOMPLETE: 1 of 1 cells"));
}

TEST_F(Verbs, ResumeMakesADamagedOrMissingRecordingAgain) {
  const auto before = files(folder_ / "run/recordings");
  for (const bool missing : {false, true}) {
    if (missing)
      fs::remove_all(folder_ / "run/recordings");
    else
      fs::resize_file(folder_ / "run/recordings/room/1/ranges.npy", 100);
    EXPECT_EQ(here({"run", "room.yaml", "--out", "run", "--resume", "-q"}).code, 0);
    EXPECT_THAT(differences(before, files(folder_ / "run/recordings")), IsEmpty());
  }
}

TEST_F(Verbs, RunIntoTheSameFolderReplacesItAndKeepsWhatIsNotOurs) {
  folder_.write("run/notes.txt", "mine");
  ASSERT_EQ(here({"run", "room.yaml", "--out", "run", "-q", "--seed", "7"}).code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "run/cells/room/iepf/7/lines.csv"));
  EXPECT_FALSE(fs::exists(folder_ / "run/cells/room/iepf/1"));
  EXPECT_FALSE(fs::is_empty(folder_ / "run/figures"));
  EXPECT_THAT(read(folder_ / "run/effective.yaml"), HasSubstr("seeds: [7]"));
  EXPECT_EQ(read(folder_ / "run/notes.txt"), "mine");
  EXPECT_THAT(half_written(folder_.path()), IsEmpty());
}

TEST_F(Verbs, RunTakesSuitesAndPathsWithBlanksAndUmlauts) {
  folder_.write("my suite.yaml", "schema: 1\nscenarios: [room.yaml, höhle.yaml]\nseeds: [3, 4]\n");
  folder_.write("höhle.yaml", "name: cave\n" + room_with("0.10", "0.2"));
  const auto outcome = here({"run", "my suite.yaml", "--out", "deep/er/größer und mehr", "--json", "--no-figures"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(outcome.out).at("cells").size(), 4U);
  EXPECT_TRUE(fs::exists(folder_ / "deep/er/größer und mehr/cells/cave/iepf/4/lines.csv"));
}

TEST_F(Verbs, NothingButATerminalGetsEscapeCodes) {
  for (const Env& env : {Env{}, Env{{"NO_COLOR", "1"}}, Env{{"TERM", "xterm-256color"}, {"CLICOLOR_FORCE", "1"}}}) {
    const auto outcome = here({"run", "room.yaml", "--out", "plain"}, env);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.out, AllOf(HasSubstr("precision"), Not(HasSubstr("\x1b"))));
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("room/iepf/1"), Not(HasSubstr("\x1b")), Not(HasSubstr("\r"))));
  }
}

}  // namespace
}  // namespace scanbench::app_test
