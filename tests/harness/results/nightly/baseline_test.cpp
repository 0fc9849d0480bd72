// Baselines: accepted values as files.
#include "harness/results/nightly/baseline.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/special_values.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/io/process/child.hpp"
#include "harness/results/analysis/comparison.hpp"
#include "harness/results/nightly/comparison_tables.hpp"
#include "tests/harness/results/analysis/made_up_runs.hpp"
#include "tests/support/inputs.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::results {
namespace {

using fixtures::f1_run;
using ::testing::AllOf;
using ::testing::HasSubstr;

Gates f1_gate() {
  return Gates(study::GateSpec{{{"f1", 0.01}}});
}

TEST(Baseline, GivesBackTheValuesOfTheGatesToTheBit) {
  const support::TemporaryFolder folder;
  const RunResults run = f1_run({0.1, 1.0 / 3.0, kNaN});
  const Baseline read = load_baseline(accept_baseline(folder.path(), "suite", run, f1_gate(), "first"));
  EXPECT_EQ(read.reason, "first");
  EXPECT_EQ(read.file.filename(), "0001.json");
  const Comparison c = compare(read.results, gate_values(run, f1_gate()), f1_gate());
  ASSERT_EQ(c.changes.size(), 1U);
  EXPECT_EQ(c.changes[0].finding, Finding::same);
  EXPECT_EQ(c.changes[0].pairs.size(), 3U);
  EXPECT_EQ(c.exit_code(), 0);
}

TEST(Baseline, KeepsOneValuePerGateAndCell) {
  RunResults run = f1_run({0.5});
  auto& rows = run.cells[0].rows;
  rows[0].subject = "wall 1";
  rows.push_back(rows[0]);
  rows.back().subject = "wall 2";
  rows.back().value = 0.75;
  rows.push_back(rows[0]);
  rows.back().metric = "n_false";  // no value is better
  const RunResults reduced = gate_values(run, f1_gate());
  ASSERT_EQ(reduced.cells[0].rows.size(), 1U);
  EXPECT_EQ(reduced.cells[0].rows[0].subject, kMeanOfSubjects);
  EXPECT_EQ(reduced.cells[0].rows[0].value, 0.625);
  EXPECT_EQ(reduced.cells[0].rows[0].count, 2);
}

/// A run with f1 of these walls on one seed.
RunResults run_of_walls(const std::vector<double>& walls) {
  RunResults run = f1_run({0.5});
  const auto row = run.cells[0].rows[0];
  run.cells[0].rows.clear();
  for (std::size_t i = 0; i < walls.size(); ++i) {
    run.cells[0].rows.push_back(row);
    run.cells[0].rows.back().subject = "wall " + std::to_string(i);
    run.cells[0].rows.back().value = walls[i];
  }
  return run;
}

TEST(Baseline, CountsTheWallsOfAMeanSoThatAnotherNumberIsSaid) {
  const support::TemporaryFolder folder;
  const RunResults run = run_of_walls({0.5, 0.6, 0.7});
  const Baseline read = load_baseline(accept_baseline(folder.path(), "suite", run, f1_gate(), "first"));
  EXPECT_EQ(compare(read.results, gate_values(run, f1_gate()), f1_gate()).changes.at(0).finding, Finding::same);
  const RunResults fewer = run_of_walls({0.5, kNaN, 0.7});
  const Comparison against = compare(read.results, gate_values(fewer, f1_gate()), f1_gate());
  EXPECT_EQ(against.changes.at(0).subjects.before, 3U);
  EXPECT_EQ(against.changes.at(0).subjects.after, 2U);
  const auto note_of = [](const Comparison& comparison) {
    return change_table("t", "", {&comparison.changes.at(0)}, "run").rows.at(0).cells.at(6).spread;
  };
  EXPECT_THAT(note_of(against), HasSubstr("2 walls, before 3"));
  // Two runs are compared on the walls that both have.
  const Comparison of_runs = compare(run, fewer, f1_gate());
  EXPECT_EQ(of_runs.changes.at(0).difference.mean, 0.0);
  EXPECT_THAT(note_of(of_runs), HasSubstr("2 of 3 walls"));
}

TEST(Baseline, ThatWasAcceptedBeforeWallsWereCountedStillCompares) {
  RunResults old = gate_values(run_of_walls({0.5, 0.6}), f1_gate());
  old.cells[0].rows[0].subject = "all";
  const Comparison c = compare(old, gate_values(run_of_walls({0.5, 0.6}), f1_gate()), f1_gate());
  EXPECT_EQ(c.changes.at(0).finding, Finding::same);
}

TEST(Baseline, MovesOnPurposeOnly) {
  const support::TemporaryFolder folder;
  const auto refusal = [&](const RunResults& run, const std::string& reason) {
    return support::config_refusal([&] { accept_baseline(folder.path(), "suite", run, f1_gate(), reason); });
  };
  RunResults overridden = f1_run({0.5, 0.6});
  overridden.overrides = {"sensor.sigma_m=0.02"};
  EXPECT_THAT(refusal(overridden, "by mistake"), HasSubstr("--set sensor.sigma_m=0.02"));
  accept_baseline(folder.path(), "suite", f1_run({0.5, 0.6}), f1_gate(), "first");
  EXPECT_THAT(refusal(f1_run({0.5, 0.6}), "again"), HasSubstr("has these values already"));
  EXPECT_THAT(refusal(f1_run({0.7, 0.6}), "  "), HasSubstr("--reason is empty"));
  RunResults crashed = f1_run({0.7, 0.6});
  crashed.cells[1].status = "crashed";
  EXPECT_THAT(refusal(crashed, "faster"), HasSubstr("room/iepf/2 is crashed: a baseline must be complete"));
  accept_baseline(folder.path(), "suite", f1_run({0.7, 0.6}), f1_gate(), "better corners");
  const auto files = baseline_files(folder.path(), "suite");
  ASSERT_EQ(files.size(), 2U);
  EXPECT_EQ(load_baseline(files[1]).reason, "better corners");
  EXPECT_TRUE(baseline_files(folder.path(), "other").empty());
}

TEST(Baseline, NumbersFollowTheLargestWhateverElseIsInTheFolder) {
  const support::TemporaryFolder folder;
  const auto accept = [&](double value) {
    return accept_baseline(folder.path(), "suite", f1_run({value}), f1_gate(), "why").filename().string();
  };
  EXPECT_EQ(accept(0.1), "0001.json");
  for (const char* name : {"old.json", "0007.txt", "-3.json"})
    io::write_file_atomically(folder.path() / "suite" / name, "{}");
  EXPECT_EQ(accept(0.2), "0002.json");
  io::write_file_atomically(folder.path() / "suite/10000.json", io::read_file(folder.path() / "suite/0001.json"));
  EXPECT_EQ(accept(0.3), "10001.json");
  EXPECT_EQ(baseline_files(folder.path(), "suite").size(), 4U);
}

TEST(Baseline, OfSeveralThatAreAcceptedAtOnceNoneIsLost) {
  const support::TemporaryFolder folder;
  constexpr int kProcesses = 6;
  std::vector<io::Child> children;
  for (int i = 0; i < kProcesses; ++i)
    children.push_back(io::start_child({}, [&, i] {
      accept_baseline(folder.path(), "suite", f1_run({0.1 * i}), f1_gate(), std::to_string(i));
      return 0;
    }));
  for (io::Child& child : children) EXPECT_TRUE(child.reap().is_success());
  std::set<std::string> reasons;
  for (const auto& file : baseline_files(folder.path(), "suite")) reasons.insert(load_baseline(file).reason);
  EXPECT_EQ(reasons.size(), static_cast<std::size_t>(kProcesses));
}

TEST(Baseline, OfASuiteWhoseNameLeadsElsewhereIsRefused) {
  const support::TemporaryFolder folder;
  for (const char* suite : {"../../evil", "", "..", "a/b"}) {
    const std::string refusal = support::config_refusal(
        [&] { accept_baseline(folder.path() / "in", suite, f1_run({0.5}), f1_gate(), "first"); });
    EXPECT_THAT(refusal, HasSubstr("the name of a suite is '" + std::string(suite) + "'"));
  }
  EXPECT_THAT(fixtures::listing(folder.path()), ::testing::IsEmpty());
}

TEST(Baseline, RefusesFilesOfOthers) {
  const support::TemporaryFolder folder;
  const auto refusal = [&](const std::string& text) {
    io::write_file_atomically(folder.path() / "0001.json", text);
    return support::config_refusal([&] { load_baseline(folder.path() / "0001.json"); });
  };
  EXPECT_THAT(refusal("{}"), HasSubstr("0001.json: not a baseline of scanbench"));
  EXPECT_THAT(refusal("[1, 2"), HasSubstr("0001.json"));
  EXPECT_THAT(refusal(R"({"program": "scanbench", "kind": "baseline", "schema": 9})"), HasSubstr("schema is 9"));
  EXPECT_THAT(refusal(R"({"program": "scanbench", "kind": "baseline", "schema": 2})"), HasSubstr("0001.json"));
}

TEST(Baseline, OfAnOlderMeaningIsRefusedWithTheReasonAndIsNoneOfTheCurrentOnes) {
  const support::TemporaryFolder folder;
  const auto first = accept_baseline(folder.path(), "suite", f1_run({0.5, 0.6}), f1_gate(), "first");
  std::string text = io::read_file(first);
  text.replace(text.find("\"schema\": 2"), 11, "\"schema\": 1");
  io::write_file_atomically(first, text);
  EXPECT_THAT(support::config_refusal([&] { load_baseline(first); }),
              AllOf(HasSubstr("0001.json: schema is 1; allowed: 2."), HasSubstr("walls too small to judge"),
                    HasSubstr("accept a new run")));
  const auto second = accept_baseline(folder.path(), "suite", f1_run({0.7, 0.6}), f1_gate(), "new meaning of F1");
  EXPECT_EQ(current_baselines(baseline_files(folder.path(), "suite")), std::vector{second});
}

TEST(Baseline, ThatLacksAMetricIsComparedWithoutIt) {
  const support::TemporaryFolder folder;
  const Baseline old = load_baseline(accept_baseline(folder.path(), "suite", f1_run({0.5, 0.6}), f1_gate(), "first"));
  RunResults run = f1_run({0.5, 0.6});
  for (auto& cell : run.cells) {
    cell.rows.push_back(cell.rows[0]);
    cell.rows.back().metric = "recall";
  }
  const Gates both(study::GateSpec{{{"f1", 0.01}, {"recall", 0.01}}});
  EXPECT_EQ(compare(old.results, gate_values(run, both), both).exit_code(), 0);
}

}  // namespace
}  // namespace scanbench::results
