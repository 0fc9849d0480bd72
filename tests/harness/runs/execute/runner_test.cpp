// Runs: equal bytes for any number of jobs, resume, and failed cells.
#include "harness/runs/execute/runner.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <functional>
#include <set>

#include <unistd.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/csv.hpp"
#include "harness/io/files/hash.hpp"
#include "harness/io/files/hash_list.hpp"
#include "harness/io/files/system_error.hpp"
#include "harness/runs/execute/run_options.hpp"
#include "harness/runs/execute/score.hpp"
#include "harness/runs/store/cell_status.hpp"
#include "harness/runs/store/manifest.hpp"
#include "harness/runs/store/run_file.hpp"
#include "harness/runs/store/run_lock.hpp"
#include "harness/runs/store/run_target.hpp"
#include "tests/support/inputs.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::runs {
namespace {

namespace fs = std::filesystem;
const RunFile kFigures("figures/*.png");  // its writer, the report, is not in this program
using fixtures::cell_of;
using fixtures::extract_with;
using fixtures::run_here;
using fixtures::scenario_with;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<study::Scenario> two_scenarios() {
  study::PipelineSpec merge = extract_with("merge", "test_line", {{"skip", std::int64_t{1}}});
  merge.slots.push_back({"merge", "test_merge", {}});
  return {scenario_with("one", {extract_with("a", "test_line"), extract_with("b", "test_throw"), merge}, {3, 1}),
          scenario_with("two", {extract_with("a", "test_line")}, {1, 2})};
}

TEST(Runner, LeavesTheSameBytesForAnyNumberOfJobs) {
  const support::TemporaryFolder folder;
  const auto scenarios = two_scenarios();
  const RunResult one = run_here(scenarios, {.out = folder.path() / "1", .jobs = 1});
  EXPECT_EQ(one.exit_code(), 3);
  EXPECT_EQ(one.cells.size(), 8u);
  const auto expected = fixtures::artefacts(folder.path() / "1");
  EXPECT_GT(expected.size(), 8u * 3u);
  for (const int jobs : {2, 5}) {
    const fs::path out = folder.path() / std::to_string(jobs);
    run_here(scenarios, {.out = out, .jobs = jobs});
    EXPECT_EQ(fixtures::artefacts(out), expected);
  }
}

TEST(Runner, WritesSummaryRowsInTheOrderOfTheScenarioFiles) {
  const support::TemporaryFolder folder;
  run_here(two_scenarios(), {.out = folder.path() / "r", .jobs = 2});
  const io::CsvTable table(io::read_file(folder.path() / "r" / "summary.csv"), "summary.csv");
  EXPECT_THAT(table.columns(),
              ElementsAre("scenario", "pipeline", "seed", "metric", "subject", "value", "unit", "count"));
  std::vector<std::string> order;
  for (std::size_t r = 0; r < table.rows(); ++r) {
    const std::string cell = table.text(r, "scenario") + table.text(r, "pipeline") + table.text(r, "seed");
    if (order.empty() || order.back() != cell) order.push_back(cell);
  }
  EXPECT_THAT(order, ElementsAre("onea3", "onea1", "onemerge3", "onemerge1", "twoa1", "twoa2"));
}

TEST(Runner, ResumesAfterAnInterruptToTheSameBytes) {
  const support::TemporaryFolder folder;
  const auto scenarios = two_scenarios();
  run_here(scenarios, {.out = folder.path() / "whole"});
  for (const std::size_t after : {0u, 1u, 4u}) {
    const fs::path out = folder.path() / std::to_string(after);
    RunOptions options{.out = out, .jobs = 2};
    options.progress = [&](const RunProgress& p) {
      if (p.done == after) ::raise(SIGINT);
    };
    const RunResult broken = run_here(scenarios, options);
    EXPECT_EQ(broken.exit_code(), 130);
    if (after < 4) {  // later cells may be put in place together with the fourth
      EXPECT_LT(std::ranges::count(broken.cells, true, &CellResult::done), 8);
    }
    for (const auto& name : fixtures::listing(out))
      EXPECT_FALSE(io::is_temporary_name(fs::path(name).filename().string()));

    const RunResult resumed = run_here(scenarios, {.out = out, .jobs = 1, .resume = true});
    EXPECT_EQ(resumed.exit_code(), 3);
    for (const auto& cell : broken.cells) {
      const bool was_ok = cell.done && cell.record.outcome.status == CellStatus::ok;
      const CellResult& again = cell_of(resumed, to_string(cell.key));
      EXPECT_EQ(again.reused, was_ok) << to_string(cell.key);
      if (was_ok) {
        EXPECT_EQ(again.record.outcome.wall_seconds, cell.record.outcome.wall_seconds);
      }
    }
    EXPECT_EQ(fixtures::artefacts(out), fixtures::artefacts(folder.path() / "whole"));
  }
}

TEST(Runner, ResumeRunsAgainWhatHasChangedOrIsDamagedAndNothingElse) {
  const support::TemporaryFolder folder;
  const fs::path out = folder.path() / "r";
  std::vector<study::Scenario> scenarios{
      scenario_with("s", {extract_with("a", "test_line"), extract_with("b", "test_line")})};
  run_here(scenarios, {.out = out});
  scenarios[0].pipelines[1].slots[0].params["skip"] = std::int64_t{2};
  RunResult result = run_here(scenarios, {.out = out, .resume = true});
  EXPECT_TRUE(cell_of(result, "s/a/1").reused);
  EXPECT_FALSE(cell_of(result, "s/b/1").reused);

  fs::remove(out / "cells/s/a/1/metrics.csv");
  result = run_here(scenarios, {.out = out, .resume = true});
  EXPECT_FALSE(cell_of(result, "s/a/1").reused);
  EXPECT_TRUE(cell_of(result, "s/b/1").reused);
  EXPECT_TRUE(fs::exists(out / "cells/s/a/1/metrics.csv"));

  fs::remove_all(out / "recordings");
  result = run_here(scenarios, {.out = out, .resume = true});
  EXPECT_TRUE(fs::exists(out / "recordings/s/1/scan.json"));
  run_here(scenarios, {.out = folder.path() / "fresh"});
  EXPECT_EQ(fixtures::artefacts(out), fixtures::artefacts(folder.path() / "fresh"));
}

/// The manifest of a killed run, which names no list of files.
void forget_artefacts(const fs::path& run) {
  auto json = nlohmann::ordered_json::parse(io::read_file(run / "manifest.json"));
  json["state"] = "running";
  ASSERT_EQ(json.erase("artefacts_sha256"), 1u);
  io::write_file_atomically(run / "manifest.json", json.dump());
}

TEST(Runner, ResumeRunsAgainACellWithADamagedFile) {
  const support::TemporaryFolder folder;
  study::PipelineSpec merging = extract_with("merging", "test_line");
  merging.slots.push_back({"merge", "test_merge", {}});
  const std::vector<study::Scenario> scenarios{scenario_with("s", {merging, extract_with("other", "test_line")})};
  const fs::path out = folder.path() / "r";
  run_here(scenarios, {.out = out, .journal = true});
  const auto whole = fixtures::artefacts(out);
  const fs::path cell = out / "cells/s/merging/1";

  const auto remove = [](const fs::path& file) { fs::remove(file); };
  const auto cut = [](const fs::path& file) { fs::resize_file(file, fs::file_size(file) / 2); };
  const auto change = [](const fs::path& file) {  // the last digit
    std::string bytes = io::read_file(file);
    const std::size_t at = bytes.find_last_of("0123456789");
    bytes.at(at) = bytes[at] == '7' ? '8' : '7';
    io::write_file_atomically(file, bytes);
  };
  using Damage = std::function<void(const fs::path&)>;
  const std::vector<std::pair<std::string, std::vector<Damage>>> cases{
      {"lines.csv", {remove, cut, change}}, {"labels.npy", {remove, cut}},
      {"map.csv", {remove, cut, change}},   {"merge_labels.csv", {remove, cut, change}},
      {"poses.csv", {remove, cut, change}}, {"timing.csv", {remove, cut, change}},
      {"trace.csv", {remove, cut, change}}, {"metrics.csv", {remove, cut, change}}};
  ASSERT_EQ(cases.size() + 1, fixtures::listing(cell).size());  // and status.json
  for (const auto& [name, damages] : cases)
    for (std::size_t i = 0; i < damages.size(); ++i)
      for (const bool killed : {false, true}) {
        if (killed && i > 0) continue;  // without hashes a changed file is not noticed, but a missing one is
        SCOPED_TRACE(name + ", damage " + std::to_string(i) + (killed ? ", killed" : ""));
        damages[i](cell / name);
        if (killed) forget_artefacts(out);
        const RunResult result = run_here(scenarios, {.out = out, .resume = true, .journal = true});
        EXPECT_FALSE(cell_of(result, "s/merging/1").reused);
        EXPECT_TRUE(cell_of(result, "s/other/1").reused);
        EXPECT_EQ(fixtures::artefacts(out), whole);
      }
  forget_artefacts(out);
  const RunResult result = run_here(scenarios, {.out = out, .resume = true, .journal = true});
  EXPECT_TRUE(cell_of(result, "s/merging/1").reused);
}

TEST(Runner, TurnsEveryKindOfFailureIntoARow) {
  const support::TemporaryFolder folder;
  study::Scenario scenario =
      scenario_with("s", {extract_with("ok", "test_line"), extract_with("failed", "test_throw"),
                          extract_with("crashed", "test_crash"), extract_with("left", "test_leave"),
                          extract_with("timeout", "test_hang"), extract_with("invalid", "test_wrong_labels"),
                          extract_with("unknown", "no such module")});
  scenario.limits = {.seconds = 3.0, .memory_bytes = 1e9};
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  scenario.pipelines.push_back(extract_with("out_of_memory", "test_eat"));
#endif
  const RunResult result = run_here({scenario}, {.out = folder.path() / "r", .jobs = 2});
  EXPECT_EQ(result.exit_code(), 3);
  for (const auto& cell : result.cells) {
    const std::string expected = cell.key.pipeline == "left"      ? "crashed"
                                 : cell.key.pipeline == "unknown" ? "failed"
                                                                  : cell.key.pipeline;
    EXPECT_TRUE(cell.done);
    EXPECT_EQ(to_string(cell.record.outcome.status), expected) << cell.record.outcome.message;
    const fs::path path = cell_path(folder.path() / "r", cell.key);
    EXPECT_EQ(to_string(load_status(path).outcome.status), expected);
    if (expected != "ok") {
      EXPECT_THAT(fixtures::listing(path), ElementsAre("status.json"));
    }
  }
  EXPECT_THAT(cell_of(result, "s/crashed/1").record.outcome.message, HasSubstr("a last word before the fall"));
  EXPECT_THAT(cell_of(result, "s/failed/1").record.outcome.message, HasSubstr("cannot go on"));
  EXPECT_THAT(cell_of(result, "s/invalid/1").record.outcome.message, HasSubstr("frame 2: 15 labels for 16 beams"));
  EXPECT_THAT(io::read_file(folder.path() / "r" / "summary.csv"), HasSubstr("s,ok,1,"));
}

TEST(Runner, RefusesAFolderThatIsNotARunAndLeavesItAlone) {
  const support::TemporaryFolder folder;
  io::write_file_atomically(folder.path() / "thesis.tex", "years of work");
  for (const bool resume : {false, true})
    EXPECT_THROW(run_here(two_scenarios(), {.out = folder.path(), .resume = resume}), ConfigError);
  EXPECT_THROW(run_here(two_scenarios(), {.out = folder.path() / "thesis.tex"}), ConfigError);
  io::write_file_atomically(folder.path() / "manifest.json", "{\"name\": \"a web page\"}");
  EXPECT_THROW(run_here(two_scenarios(), {.out = folder.path()}), ConfigError);
  EXPECT_THAT(fixtures::listing(folder.path()), ElementsAre("manifest.json", "thesis.tex"));
}

TEST(Runner, ReplacesAnOldRunOnlyWhenTheNewOneIsThere) {
  const support::TemporaryFolder folder;
  const fs::path out = folder.path() / "r";
  run_here({scenario_with("old", {extract_with("a", "test_line")})}, {.out = out});
  io::make_folders(out / "figures");
  io::write_file_atomically(out / "figures" / "environment.png", "of the old run");
  io::write_file_atomically(out / "notes.txt", "mine");
  const auto before = fixtures::listing(folder.path());
  const std::vector<study::Scenario> scenarios{scenario_with("new", {extract_with("a", "test_line")}, {1, 2})};

  RunOptions options{.out = out};
  options.progress = [](const RunProgress& p) {
    if (p.done == 1) ::raise(SIGINT);
  };
  EXPECT_EQ(run_here(scenarios, options).exit_code(), 130);
  EXPECT_EQ(fixtures::listing(folder.path()), before);

  EXPECT_EQ(run_here(scenarios, {.out = out}).exit_code(), 0);
  EXPECT_EQ(io::read_file(out / "notes.txt"), "mine");
  EXPECT_TRUE(fs::exists(out / "cells/new/a/2/status.json"));
  for (const char* gone : {"cells/old", "recordings/old", "figures/environment.png"})
    EXPECT_FALSE(fs::exists(out / gone));
  std::size_t beside = 0;
  for (const auto& entry : fs::directory_iterator(folder.path())) beside += entry.exists();
  EXPECT_EQ(beside, 1u);
}

TEST(Runner, BadInputLeavesNothingBehind) {
  const support::TemporaryFolder folder;
  RunServices bad = fixtures::services();
  bad.recording = [](const study::Scenario&, std::uint64_t, int) -> Recording {
    throw ConfigError("the path crosses wall w3");
  };
  const fs::path out = folder.path() / "r";
  try {
    run_with(two_scenarios(), {.out = out}, bad);
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_STREQ(e.what(), "the path crosses wall w3");
  }
  EXPECT_FALSE(fs::exists(out));

  // One bad scenario among good ones loses only its own cells.
  bad.recording = [](const study::Scenario& s, std::uint64_t seed, int) -> Recording {
    if (s.name == "one") throw ConfigError("the path crosses wall w3");
    return fixtures::random_recording(seed, 5, 16, true);
  };
  const RunResult result = run_with(two_scenarios(), {.out = out}, bad);
  EXPECT_EQ(result.exit_code(), 3);
  EXPECT_EQ(cell_of(result, "one/a/1").record.outcome.status, CellStatus::skipped);
  EXPECT_THAT(cell_of(result, "one/a/1").record.outcome.message, HasSubstr("the path crosses wall w3"));
  EXPECT_EQ(cell_of(result, "two/a/1").record.outcome.status, CellStatus::ok);
}

TEST(Runner, ARecordingThatCrashesOrHangsSkipsItsCells) {
  const support::TemporaryFolder folder;
  RunServices broken = fixtures::services();
  broken.recording = [](const study::Scenario& s, std::uint64_t seed, int) -> Recording {
    if (s.name == "one") ::raise(SIGKILL);
    return fixtures::random_recording(seed, 5, 16, true);
  };
  const RunResult result = run_with(two_scenarios(), {.out = folder.path() / "r", .jobs = 2}, broken);
  EXPECT_EQ(result.exit_code(), 3);
  EXPECT_EQ(cell_of(result, "one/merge/3").record.outcome.status, CellStatus::skipped);
  EXPECT_EQ(cell_of(result, "two/a/2").record.outcome.status, CellStatus::ok);
}

TEST(Runner, SelectsByScenarioByPipelineAndByBoth) {
  const support::TemporaryFolder folder;
  const auto selection = [&](std::vector<std::string> only) {
    auto scenarios = two_scenarios();
    for (auto& scenario : scenarios) scenario.seeds = {9};
    std::string text;
    for (const auto& cell : run_here(scenarios, {.out = folder.path() / "r", .only = only}).cells)
      text += to_string(cell.key) + " ";
    return text;
  };
  EXPECT_EQ(selection({"two"}), "two/a/9 ");
  EXPECT_EQ(selection({"a"}), "one/a/9 two/a/9 ");
  EXPECT_EQ(selection({"one/merge", "two/a"}), "one/merge/9 two/a/9 ");
  EXPECT_THROW(selection({"three"}), ConfigError);
}

TEST(Runner, ManifestNamesTheListOfEveryFileWithItsHash) {
  const support::TemporaryFolder folder;
  const fs::path out = folder.path() / "r";
  run_here(two_scenarios(), {.out = out, .argv = {"scanbench", "run"}});
  const auto manifest = nlohmann::json::parse(io::read_file(out / "manifest.json"));
  EXPECT_EQ(manifest["artefacts_sha256"], io::sha256_of_file(out / "artefacts.sha256"));
  io::FileHashes expected;
  for (const auto& name : fixtures::listing(out))
    if (fs::is_regular_file(out / name) && name != "manifest.json" && name != "artefacts.sha256")
      expected[name] = io::sha256_of_file(out / name);
  EXPECT_EQ(listed_hashes(out), expected);
  for (const char* key : {"version", "git_commit", "compiler", "flags", "libraries", "cpu", "start", "end"})
    EXPECT_TRUE(manifest.contains(key)) << key;
  EXPECT_EQ(manifest["state"], "complete");
  EXPECT_EQ(manifest["seeds"], nlohmann::json({1, 2, 3}));
  EXPECT_EQ(manifest["argv"], nlohmann::json({"scanbench", "run"}));
  EXPECT_EQ(io::read_file(out / "scenarios/one.yaml"), "about: one\n");
  EXPECT_EQ(io::read_file(out / "effective/two.yaml"), "about: two\neffective: true\n");
  EXPECT_EQ(load_manifest(out).cells.size(), 8u);
}

TEST(Runner, LeavesAListThatSha256sumChecks) {
  const support::TemporaryFolder folder;
  const fs::path out = folder.path() / "r";
  run_here(two_scenarios(), {.out = out});
  const std::string check =
      "cd '" + out.string() + "' && LC_ALL=C sha256sum --check --strict --status artefacts.sha256";
  EXPECT_EQ(std::system(check.c_str()), 0);
  run_here(two_scenarios(), {.out = out, .resume = true});
  EXPECT_EQ(std::system(check.c_str()), 0);
  io::write_file_atomically(out / "cells/one/a/1/metrics.csv", "tampered\n");
  EXPECT_NE(std::system(check.c_str()), 0);
}

TEST(Runner, ResumeRefusesAListThatTheManifestDoesNotName) {
  const support::TemporaryFolder folder;
  const std::vector<study::Scenario> scenarios{scenario_with("s", {extract_with("a", "test_line")})};
  const fs::path out = folder.path() / "r", list = out / "artefacts.sha256";
  run_here(scenarios, {.out = out});
  const auto refusal = [&] {
    return support::config_refusal([&] { run_here(scenarios, {.out = out, .resume = true}); });
  };
  // A changed file with a list to match.
  const std::string whole = io::read_file(list);
  const fs::path cell = out / "cells/s/a/1/lines.csv";
  std::string changed = whole;
  const std::string before = io::sha256_of_file(cell);
  io::write_file_atomically(cell, io::read_file(cell) + "\n");
  changed.replace(changed.find(before), before.size(), io::sha256_of_file(cell));
  io::write_file_atomically(list, changed);
  EXPECT_THAT(refusal(), HasSubstr("artefacts.sha256 is missing or is not the list of files that manifest.json names"));
  fs::remove(list);
  EXPECT_THAT(refusal(), HasSubstr("artefacts.sha256 is missing"));
  // With the old list, the changed file is found.
  io::write_file_atomically(list, whole);
  EXPECT_FALSE(cell_of(run_here(scenarios, {.out = out, .resume = true}), "s/a/1").reused);
  fs::remove(list);
  EXPECT_EQ(run_here(scenarios, {.out = out}).exit_code(), 0);
  EXPECT_EQ(io::read_file(list).size(), whole.size());
}

TEST(Runner, NamesNoListWhileItRuns) {
  const support::TemporaryFolder folder;
  const fs::path out = folder.path() / "r";
  const std::vector<study::Scenario> scenarios{scenario_with("s", {extract_with("a", "test_line")})};
  run_here(scenarios, {.out = out});
  RunServices observed = fixtures::services();
  bool was_listed = true;
  observed.effective_yaml = [&](const study::Scenario& s, const study::StoredInputs&) {
    was_listed = fs::exists(out / "artefacts.sha256") ||
                 nlohmann::json::parse(io::read_file(out / "manifest.json")).contains("artefacts_sha256");
    return s.text + "effective: true\n";
  };
  run_with(scenarios, {.out = out, .resume = true}, observed);
  EXPECT_FALSE(was_listed);
  EXPECT_FALSE(listed_hashes(out).empty());
}

TEST(Runner, ManifestOfAnEarlierVersionGetsAListWhenItIsRefreshed) {
  const support::TemporaryFolder folder;
  const fs::path out = folder.path() / "r";
  run_here({scenario_with("s", {extract_with("a", "test_line")})}, {.out = out});
  const io::FileHashes hashes = listed_hashes(out);
  auto json = nlohmann::ordered_json::parse(io::read_file(out / "manifest.json"));
  json.erase("artefacts_sha256");
  json["artefacts"] = {{{"path", "summary.csv"}, {"sha256", "0"}}};
  io::write_file_atomically(out / "manifest.json", json.dump());
  fs::remove(out / "artefacts.sha256");
  EXPECT_TRUE(listed_hashes(out).empty());
  refresh_manifest(out);
  EXPECT_EQ(listed_hashes(out), hashes);
  EXPECT_FALSE(nlohmann::json::parse(io::read_file(out / "manifest.json")).contains("artefacts"));
}

TEST(Runner, OfOneScenarioWritesItsFileAtTheTop) {
  const support::TemporaryFolder folder;
  run_here({scenario_with("s", {extract_with("a", "test_line")})}, {.out = folder.path() / "r", .journal = true});
  EXPECT_EQ(io::read_file(folder.path() / "r/scenario.yaml"), "about: s\n");
  EXPECT_TRUE(fs::exists(folder.path() / "r/effective.yaml"));
  EXPECT_THAT(io::read_file(folder.path() / "r/cells/s/a/1/trace.csv"), HasSubstr("extract,0,segment,line,"));
}

TEST(Runner, ACellThatCannotBeWrittenMakesTheRunIncomplete) {
  const support::TemporaryFolder folder;
  const fs::path out = folder.path() / "r";
  const std::vector<study::Scenario> scenarios{
      scenario_with("s", {extract_with("a", "test_line"), extract_with("b", "test_line")})};
  run_here(scenarios, {.out = out});
  fs::remove_all(out / "cells/s/a");
  io::write_file_atomically(out / "cells/s/a", "a file where a folder must be");
  const RunResult result = run_here(scenarios, {.out = out, .resume = true});
  EXPECT_EQ(result.exit_code(), 4);
  EXPECT_FALSE(cell_of(result, "s/a/1").done);
  EXPECT_TRUE(cell_of(result, "s/b/1").reused);
}

TEST(Runner, AnErrorOfTheSystemMakesACellMissingAndKeepsTheOldRun) {
  const support::TemporaryFolder folder;
  const fs::path out = folder.path() / "r";
  run_here({scenario_with("s", {extract_with("a", "test_line"), extract_with("b", "test_line")})}, {.out = out});
  const auto before = fixtures::listing(folder.path());
  const auto bytes = fixtures::artefacts(out);
  const std::vector<study::Scenario> full{
      scenario_with("s", {extract_with("a", "test_line"), extract_with("b", "test_full_disk")})};
  int drawn = 0;
  const RunResult result = run_here(full, {.out = out, .finish = [&](const RunResult&) { ++drawn; }});
  EXPECT_EQ(result.exit_code(), 4);
  EXPECT_TRUE(result.old_run_kept);
  EXPECT_EQ(drawn, 0);
  EXPECT_FALSE(cell_of(result, "s/b/1").done);
  EXPECT_THAT(cell_of(result, "s/b/1").record.outcome.message, HasSubstr("File too large"));
  EXPECT_EQ(fixtures::listing(folder.path()), before);
  EXPECT_EQ(fixtures::artefacts(out), bytes);

  // Nothing is lost in a new folder: finished cells stay, and only the rest is run again.
  const RunResult fresh = run_here(full, {.out = folder.path() / "new"});
  EXPECT_EQ(fresh.exit_code(), 4);
  EXPECT_FALSE(fresh.old_run_kept);
  EXPECT_FALSE(fs::exists(folder.path() / "new/cells/s/b/1"));
  EXPECT_EQ(nlohmann::json::parse(io::read_file(folder.path() / "new/manifest.json"))["state"], "incomplete");
  EXPECT_TRUE(cell_of(run_here(full, {.out = folder.path() / "new", .resume = true}), "s/a/1").reused);
}

TEST(Runner, ARecordingThatTheSystemRefusesMakesItsCellsMissing) {
  const support::TemporaryFolder folder;
  RunServices broken = fixtures::services();
  broken.recording = [](const study::Scenario& s, std::uint64_t seed, int) -> Recording {
    if (s.name == "one") throw io::SystemError("the disk is full");
    return fixtures::random_recording(seed, 5, 16, true);
  };
  const RunResult result = run_with(two_scenarios(), {.out = folder.path() / "r"}, broken);
  EXPECT_EQ(result.exit_code(), 4);
  EXPECT_FALSE(cell_of(result, "one/a/1").done);
  EXPECT_EQ(cell_of(result, "one/a/1").record.outcome.message, "the disk is full");
  EXPECT_TRUE(cell_of(result, "two/a/1").done);
}

TEST(Runner, ASelectionKeepsTheOtherCellsOfAnEarlierRun) {
  const support::TemporaryFolder folder;
  const fs::path out = folder.path() / "r";
  std::vector<study::Scenario> scenarios{
      scenario_with("s", {extract_with("a", "test_line"), extract_with("b", "test_line")})};
  run_here(scenarios, {.out = out});
  const auto before = fixtures::artefacts(out);
  const RunResult result = run_here(scenarios, {.out = out, .only = {"a"}});
  ASSERT_EQ(result.cells.size(), 1u);
  EXPECT_FALSE(result.cells[0].reused);
  EXPECT_EQ(fixtures::artefacts(out), before);

  // Cells of other input can neither stay nor be dropped without a message.
  scenarios[0].pipelines[1].slots[0].params["skip"] = std::int64_t{2};
  EXPECT_THROW(run_here(scenarios, {.out = out, .only = {"a"}}), ConfigError);
  EXPECT_THROW(run_here({scenario_with("t", {extract_with("a", "test_line")})}, {.out = out, .only = {"a"}}),
               ConfigError);
  EXPECT_EQ(fixtures::artefacts(out), before);
  EXPECT_EQ(run_here(scenarios, {.out = out, .only = {"b"}}).exit_code(), 0);
}

TEST(Runner, WithoutABenchmarkRemovesThatOfAnEarlierRun) {
  const support::TemporaryFolder folder;
  const fs::path out = folder.path() / "r";
  run_here(
      two_scenarios(),
      {.out = out, .rules = {.benchmark = study::BenchmarkSpec{.about = "", .baseline = "one", .example = "one"}}});
  EXPECT_TRUE(fs::exists(out / "benchmark.json"));
  run_here({scenario_with("other", {extract_with("a", "test_line")})}, {.out = out, .resume = true});
  EXPECT_FALSE(fs::exists(out / "benchmark.json"));
}

TEST(Runner, UsesAFolderThatHoldsNothingButTemporaryFilesOfAKilledRun) {
  const support::TemporaryFolder folder;
  const fs::path out = folder.path() / "r";
  io::make_folders(out);
  io::write_staged_file(out / ".manifest.json.tmp-1", "{");
  EXPECT_EQ(run_here({scenario_with("s", {extract_with("a", "test_line")})}, {.out = out}).exit_code(), 0);
  EXPECT_FALSE(fs::exists(out / ".manifest.json.tmp-1"));
}

TEST(Runner, RemovesWhatAKilledRunLeftBesideItWhoeverHasItsProcessNumberNow) {
  const support::TemporaryFolder folder;
  const fs::path stale = folder.path() / (".r.tmp-" + std::to_string(::getppid()));
  io::make_folders(stale);
  io::write_staged_file(stale / ".manifest.json.tmp-1", "{");
  run_here({scenario_with("s", {extract_with("a", "test_line")})}, {.out = folder.path() / "r"});
  EXPECT_FALSE(fs::exists(stale));
}

TEST(Runner, NamesOneFolderHoweverItsPathIsWritten) {
  const support::TemporaryFolder folder;
  io::make_folders(folder.path() / "elsewhere/deep");
  fs::create_directory_symlink(folder.path() / "elsewhere/deep", folder.path() / "x");
  const RunResult result =
      run_here({scenario_with("s", {extract_with("a", "test_line")})}, {.out = folder.path() / "x/../y"});
  EXPECT_EQ(result.out, folder.path() / "y");
  EXPECT_TRUE(fs::exists(result.out / "summary.csv"));
  EXPECT_FALSE(fs::exists(folder.path() / "elsewhere/y"));
}

TEST(Runner, HoldsItsLockUntilReportsAreWritten) {
  const support::TemporaryFolder folder;
  const fs::path out = folder.path() / "r";
  const std::vector<study::Scenario> scenarios{scenario_with("s", {extract_with("a", "test_line")})};
  int refused = 0;
  for (const bool replaces : {false, true}) {
    SCOPED_TRACE(replaces);
    run_here(scenarios, {.out = out, .finish = [&](const RunResult& result) {
                           EXPECT_TRUE(fs::exists(result.out / "summary.csv"));
                           EXPECT_THROW(RunLock{out}, ConfigError);
                           ++refused;
                         }});
    EXPECT_NO_THROW(RunLock{out});
  }
  EXPECT_EQ(refused, 2);
}

TEST(Runner, IsCompleteWhenItsReportsAreWrittenAndNotBefore) {
  const support::TemporaryFolder folder;
  const fs::path out = folder.path() / "r";
  const auto state = [&] { return nlohmann::json::parse(io::read_file(out / "manifest.json")).at("state"); };
  const std::vector<study::Scenario> scenarios{scenario_with("s", {extract_with("a", "test_line")})};
  for (const bool replaces : {false, true}) {
    SCOPED_TRACE(replaces);
    run_here(scenarios, {.out = out, .finish = [&](const RunResult&) { EXPECT_EQ(state(), "running"); }});
    EXPECT_EQ(state(), "complete");
  }
  EXPECT_THROW(run_here(scenarios, {.out = out, .finish = [](const RunResult&) { throw std::runtime_error("stop"); }}),
               std::runtime_error);
  EXPECT_EQ(state(), "interrupted");
}

TEST(Runner, TwoRunsInOneFolderAtATimeAreRefused) {
  const support::TemporaryFolder folder;
  const fs::path out = folder.path() / "r";
  int refused = 0;
  RunOptions options{.out = out};
  options.progress = [&](const RunProgress&) {
    try {
      const RunTarget second(out, true);
    } catch (const ConfigError& e) {
      refused += std::string(e.what()).find("another run") != std::string::npos;
    }
  };
  run_here(two_scenarios(), options);
  EXPECT_GT(refused, 0);
  EXPECT_NO_THROW(RunTarget(out, true));
}

TEST(Runner, RefusesNamesThatCannotBeFolders) {
  const support::TemporaryFolder folder;
  for (const std::string name : {"", "..", "a/b", ".hidden"}) {
    EXPECT_THROW(run_here({scenario_with(name, {extract_with("a", "test_line")})}, {.out = folder.path() / "r"}),
                 ConfigError);
    EXPECT_THROW(run_here({scenario_with("s", {extract_with(name, "test_line")})}, {.out = folder.path() / "r"}),
                 ConfigError);
  }
  const study::Scenario s = scenario_with("s", {extract_with("a", "test_line")});
  EXPECT_THROW(run_here({s, s}, {.out = folder.path() / "r"}), ConfigError);
  EXPECT_THROW(run_here({s}, {.out = folder.path() / "r", .jobs = 0}), ConfigError);
  EXPECT_TRUE(fixtures::listing(folder.path()).empty());
}

}  // namespace
}  // namespace scanbench::runs
