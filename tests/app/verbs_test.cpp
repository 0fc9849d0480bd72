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

TEST(Catalog, SaysWhichParametersMustBeGiven) {
  const auto text = run({"describe", "carmen"});
  EXPECT_THAT(text.out, testing::ContainsRegex("no_return_m +required +m"));
  EXPECT_THAT(text.out, testing::ContainsRegex("range_min_m +0 +m"));
  EXPECT_THAT(run({"describe", "csv"}).out, testing::ContainsRegex("no_return_m +0 +m"));
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
  for (const char* name : {"manifest.json", "artefacts.sha256"}) std::erase(changed, name);
  EXPECT_THAT(changed, IsEmpty());
}

TEST_F(Verbs, CompareIsGoodWithItselfAndFailsWithAWorseOne) {
  const auto same = here({"compare", "run", "run"});
  EXPECT_EQ(same.code, 0);
  EXPECT_THAT(same.out, testing::StartsWith("PASS: none of "));
  // A threshold of two metres rounds off every corner, so walls are not found.
  ASSERT_EQ(here({"run", "room.yaml", "-q", "--no-figures", "--out", "worse", "--set",
                  "pipelines.iepf.extract.params.threshold_m=2"})
                .code,
            0);
  const auto worse =
      here({"compare", "run", "worse", "--out", "rows.csv", "--out", "c.json", "-o", "c.md", "-o", "c.xml"});
  EXPECT_EQ(worse.code, 1) << worse.out << worse.err;
  EXPECT_THAT(worse.out, testing::StartsWith("FAIL: "));
  EXPECT_THAT(worse.out, HasSubstr("room: pipelines.iepf.extract.params.threshold_m: 0.1 -> 2"));
  EXPECT_THAT(read(folder_ / "rows.csv"), HasSubstr("precision"));
  EXPECT_EQ(nlohmann::json::parse(read(folder_ / "c.json")).at("verdict"), "FAIL");
  EXPECT_THAT(read(folder_ / "c.md"), testing::StartsWith("**FAIL: "));
  EXPECT_THAT(read(folder_ / "c.xml"), HasSubstr("<failure message="));
  const auto printed = here({"compare", "run", "worse", "--json"});
  EXPECT_EQ(printed.code, 1);
  EXPECT_EQ(printed.out, read(folder_ / "c.json"));
  EXPECT_EQ(here({"compare", "run", "worse", "--format", "markdown"}).out, read(folder_ / "c.md"));
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

TEST_F(Verbs, ExportListsSeedsInTheirOrder) {
  ASSERT_EQ(here({"simulate", "room.yaml", "--out", "many", "-q", "--seed", "10,9,1,2"}).code, 0);
  const auto outcome = here({"export", "many", "--format", "tum"});
  ASSERT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out,
            "many/export/room_1.txt\nmany/export/room_2.txt\nmany/export/room_9.txt\nmany/export/room_10.txt\n");
}

TEST_F(Verbs, QuietRunsStillSayThatCellsFailed) {
  folder_.write("slow.yaml", room() + "limits: {seconds: 0.000001}\n");
  const auto outcome = here({"run", "slow.yaml", "--out", "slow", "-q", "--no-figures"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("1 of 1 cells failed"), HasSubstr("slow/iepf/1")));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
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

TEST_F(Verbs, SimulateMakesTheRecordingsOfASuite) {
  folder_.write("other.yaml", room_with("0.10", "0.2"));
  folder_.write("suite.yaml", "schema: 1\nscenarios: [room.yaml, other.yaml]\nseeds: [3, 4]\n");
  const auto outcome = here({"simulate", "suite.yaml", "--out", "simulated"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const std::string scenario : {"room", "other"}) {
    EXPECT_TRUE(fs::exists(folder_ / ("simulated/effective/" + scenario + ".yaml")));
    for (const std::string seed : {"3", "4"})
      EXPECT_TRUE(fs::exists(folder_ / ("simulated/recordings/" + scenario + "/" + seed + "/ranges.npy")));
  }
}

TEST_F(Verbs, CheckRefusesWhatRunRefusesInTheSameWords) {
  folder_.write("bare.yaml", room().substr(0, room().find("pipelines:")));
  for (const std::string file : {"bare.yaml", "empty.yaml"}) {
    if (file == "empty.yaml") folder_.write(file, read(folder_ / "bare.yaml") + "pipelines: []\n");
    const auto checked = here({"check", file});
    const auto ran = here({"run", file});
    EXPECT_EQ(checked.code, 2) << file;
    EXPECT_EQ(ran.code, 2) << file;
    EXPECT_EQ(checked.err, ran.err);
    EXPECT_THAT(checked.err, HasSubstr("pipelines"));
  }
  EXPECT_EQ(here({"check", "bare.yaml", "--simulate"}).code, 0);
  EXPECT_EQ(here({"simulate", "bare.yaml"}).code, 0);
}

TEST_F(Verbs, CheckNamesTheConditionsOfASuite) {
  folder_.write("suite.yaml",
                "schema: 1\nscenarios: [room.yaml]\nseeds: [3, 4]\n"
                "factors: {noise: {1cm: {sensor.sigma_m: 0.01}, 5cm: {sensor.sigma_m: 0.05}}}\n");
  const auto outcome = here({"check", "suite.yaml"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("suite.yaml: good: 2 scenarios, 4 cells"), HasSubstr("room-1cm: 1 pipeline"),
                                 HasSubstr("room-5cm: 1 pipeline on 2 seeds")));
}

TEST_F(Verbs, AFigureThatHasNothingToDrawSaysWhy) {
  folder_.write("swept.yaml", room_with("[environment]", "[sweep]"));
  const auto ran = here({"run", "swept.yaml", "--out", "swept"});
  EXPECT_EQ(ran.code, 0);
  const std::string why = "sweep is not drawn: no two pipelines differ in one parameter alone";
  EXPECT_THAT(ran.err, HasSubstr(why));
  EXPECT_THAT(here({"figures", "swept"}).out, HasSubstr(why));
  EXPECT_THAT(read(folder_ / "swept/report.html"), HasSubstr(why));
  folder_.write("swept.yaml", room_with("[environment]", "[{name: sweep, params: {metric: eta}}]"));
  EXPECT_THAT(here({"run", "swept.yaml", "--out", "swept"}).err,
              HasSubstr("no pipeline has a value of the metric eta"));
  folder_.write("swept.yaml", room_with("metrics: [segments]\nfigures: [environment]",
                                        "  - {name: wide, extract: {module: iepf, params: {threshold_m: 0.3}}}\n"
                                        "metrics: [segments]\nfigures: [sweep]"));
  EXPECT_THAT(here({"run", "swept.yaml", "--out", "swept"}).err, Not(HasSubstr("not drawn")));
  EXPECT_TRUE(fs::exists(folder_ / "swept/figures/swept_sweep.svg"));
}

TEST_F(Verbs, OneFaultIsOneMessage) {
  // No cell and no recording is made within a microsecond.
  folder_.write("hasty.yaml", room() + "limits: {seconds: 0.000001}\n");
  const auto outcome = here({"run", "hasty.yaml", "--out", "hasty", "--no-figures", "--seed", "1,2,3,4,5,6,7,8,9,10"});
  EXPECT_EQ(outcome.code, 3);
  std::size_t mentions = 0;
  for (auto at = outcome.err.find("there is no recording"); at != std::string::npos;
       at = outcome.err.find("there is no recording", at + 1))
    ++mentions;
  EXPECT_EQ(mentions, 2U) << outcome.err;  // the first cell, and how many more
  EXPECT_THAT(outcome.err, HasSubstr("the same in 9 more cells: hasty: skipped"));
  const std::string report = read(folder_ / "hasty/report.md");
  EXPECT_EQ(report.find("there is no recording"), report.rfind("there is no recording"));
}

TEST_F(Verbs, ADryRunCountsAndWritesNothing) {
  const auto before = files(folder_.path());
  const auto outcome = here({"run", "room.yaml", "--out", "dry", "--dry-run", "--seed", "1,2,3"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("cells"), HasSubstr("rays"), HasSubstr(std::to_string(3 * 5 * 361)),
                                 HasSubstr("nothing has been written")));
  EXPECT_THAT(differences(before, files(folder_.path())), IsEmpty());
}

TEST_F(Verbs, AMisspeltFileOrFolderGetsASuggestion) {
  EXPECT_THAT(here({"run", "rom.yaml"}).err, HasSubstr("did you mean 'room.yaml'?"));
  EXPECT_THAT(here({"figures", "rnu"}).err, HasSubstr("rnu: no such folder; did you mean 'run'?"));
  EXPECT_THAT(here({"compare", "run", "rum"}).err, HasSubstr("did you mean 'run'?"));
  EXPECT_THAT(here({"run", "room.yaml", "--only", "ipef"}).err, HasSubstr("did you mean 'iepf'?"));
  folder_.write("scenarios/hallway.yaml", room());
  EXPECT_THAT(here({"run", "hallway"}).err, HasSubstr("did you mean 'scenarios/hallway.yaml'?"));
  EXPECT_THAT(here({"run", "room.yaml", "--sed", "1"}).err, HasSubstr("did you mean '--seed'?"));
}

TEST(LogReport, NamesTheMetricsThatHaveNoValuesWithoutATruth) {
  const Folder folder;
  folder.write("robot.csv", "2,2,2,2,2,2,2,2\n2,2.1,2.2,2.3,2.2,2.1,2,2\n");
  folder.write("log.yaml",
               "schema: 1\nrecording: {log: robot.csv, format: csv, step_deg: 10}\n"
               "pipelines: [{name: iepf, extract: {module: iepf}}]\nmetrics: [segments, siadat1997]\n");
  const auto made = run({"run", "log.yaml", "--out", "out", "-q"}, {}, folder.path());
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(read(folder / "out/report.md"), HasSubstr("There is no truth: segments has no values."));
}

}  // namespace
}  // namespace scanbench::app_test
