// Comparison of two runs: pairs, intervals, findings, and cells that fail or are missing.
#include "harness/results/analysis/comparison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "core/error.hpp"
#include "core/special_values.hpp"
#include "harness/results/analysis/verdict.hpp"
#include "made_up_runs.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::results {
namespace {

namespace fs = std::filesystem;
using fixtures::extract_with;
using fixtures::f1_run;
using fixtures::made_up_run;
using fixtures::run_here;
using fixtures::scenario_with;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const study::GateSpec kF1{{{"f1", 0.01}}};

Comparison compared(const std::vector<double>& before, const std::vector<double>& after) {
  return compare(f1_run(before), f1_run(after), Gates(kF1));
}

Finding finding_of(const std::vector<double>& before, const std::vector<double>& after) {
  return compared(before, after).changes.at(0).finding;
}

TEST(Comparison, OfEqualRunsIsExactlyZero) {
  const Comparison c = compared({0.9, 0.8, kNaN}, {0.9, 0.8, kNaN});
  EXPECT_EQ(c.changes.at(0).finding, Finding::same);
  EXPECT_EQ(c.changes.at(0).difference.mean, 0.0);
  EXPECT_EQ(c.exit_code(), 0);
  EXPECT_EQ(verdict_sentence(c), "PASS: none of 1 gate is worse (1 equal to the bit).");
}

TEST(Comparison, TakesDifferencesSeedBySeed) {
  // The seeds differ by much more than the change: unpaired, nothing would be found.
  const Comparison c = compared({0.9, 0.5, 0.7, 0.3}, {0.85, 0.452, 0.648, 0.25});
  const MetricChange& change = c.changes.at(0);
  EXPECT_NEAR(change.difference.mean, -(0.05 + 0.048 + 0.052 + 0.05) / 4, 1e-12);
  // Student's t with 3 degrees of freedom: 3.1824 standard errors.
  const double deviation = std::sqrt((0.0 + 0.000004 + 0.000004 + 0.0) / 3.0);
  EXPECT_NEAR(change.difference.low, -0.05 - 3.18245 * deviation / 2, 1e-6);
  EXPECT_NEAR(change.effect, -0.05 / deviation, 1e-6);
  EXPECT_EQ(change.finding, Finding::worse);
  EXPECT_EQ(change.worst()->seed, 3U);
  EXPECT_EQ(c.exit_code(), 1);
  EXPECT_THAT(verdict_sentence(c), HasSubstr("FAIL: 1 of 1 gate is worse. Worse: f1 of iepf in room fell from 0.6 to "
                                             "0.55 (by 0.05, 95 % interval "));
}

TEST(Comparison, CountsWorseGatesByPipelineAndNamesTheWorst) {
  const auto value = [](double of_iepf, double of_lt) {
    return
        [=](const std::string& pipeline, const auto&, std::uint64_t) { return pipeline == "iepf" ? of_iepf : of_lt; };
  };
  const study::GateSpec both{{{"f1", 0.01}, {"recall", 0.01}}};
  const Comparison c = compare(made_up_run({"iepf", "lt"}, {"f1", "recall"}, 4, value(0.8, 0.8)),
                               made_up_run({"iepf", "lt"}, {"f1", "recall"}, 4, value(0.7, 0.5)), Gates(both));
  EXPECT_THAT(verdict_sentence(c), HasSubstr("FAIL: 4 of 4 gates are worse: 2 of lt in room, 2 of iepf in room. The "
                                             "worst: f1 of lt in room fell from 0.8 to 0.5"));
}

TEST(Comparison, NamesASettingThatDiffersInSeveralScenariosOnce) {
  RunResults a = f1_run({0.9}), b = f1_run({0.9});
  for (const char* scenario : {"attic", "cellar", "hall", "room"}) {
    a.settings[scenario] = {{"sensor.noise_m", "0.01"}};
    b.settings[scenario] = {{"sensor.noise_m", "0.05"}};
  }
  EXPECT_THAT(compare(a, b, Gates(kF1)).differing,
              ElementsAre("attic, cellar, hall and 1 more: sensor.noise_m: 0.01 -> 0.05"));
}

TEST(Comparison, NeedsTheIntervalAndTheTolerance) {
  EXPECT_EQ(finding_of({0.9, 0.8, 0.7}, {0.895, 0.796, 0.694}), Finding::within);  // certain, but below 0.01
  EXPECT_EQ(finding_of({0.9, 0.8, 0.7}, {0.8, 0.9, 0.6}), Finding::uncertain);     // above, but seeds disagree
  EXPECT_EQ(finding_of({0.9, 0.8, 0.7}, {0.85, 0.749, 0.651}), Finding::worse);
  EXPECT_EQ(finding_of({0.85, 0.749, 0.651}, {0.9, 0.8, 0.7}), Finding::better);
  EXPECT_EQ(compared({0.9, 0.8, 0.7}, {0.8, 0.9, 0.6}).exit_code(), 0);
}

TEST(Comparison, OfASinglePairIsExact) {
  EXPECT_EQ(finding_of({0.9}, {0.85}), Finding::worse);  // a log: the same scans, so the code is the cause
  EXPECT_EQ(finding_of({0.9}, {0.895}), Finding::within);
}

TEST(Comparison, OfFewerThanThreeSeedsComparesWithTheToleranceAlone) {
  // Student's t with one degree of freedom is 12.7: no interval of two seeds like these would exclude zero.
  const Comparison two = compared({0.995, 0.991}, {0.737, 0.837});
  EXPECT_EQ(two.changes.at(0).finding, Finding::worse);
  EXPECT_EQ(two.exit_code(), 1);
  EXPECT_THAT(verdict_sentence(two), HasSubstr("fell from 0.993 to 0.787 (by 0.206, without an interval: 2 seeds are "
                                               "too few; tolerance 0.01)"));
  EXPECT_TRUE(std::isnan(two.changes.at(0).p));
  EXPECT_THAT(verdict_sentence(compared({0.9}, {0.8})), HasSubstr("without an interval: 1 seed is too few"));
  EXPECT_EQ(finding_of({0.9, 0.8}, {0.892, 0.792}), Finding::within);
  const Comparison better = compared({0.737, 0.837}, {0.995, 0.991});
  EXPECT_EQ(better.exit_code(), 0);
  EXPECT_THAT(verdict_sentence(better),
              HasSubstr("1 gate changed on fewer than three seeds, where the tolerance alone decides."));
}

TEST(Comparison, OfAValueThatIsLostIsWorseAndAnInfiniteOneIsNeverBetter) {
  EXPECT_EQ(finding_of({0.9, 0.8, 0.7}, {0.9, kNaN, 0.7}), Finding::worse);
  EXPECT_EQ(finding_of({0.9, 0.8, 0.7}, {0.9, kInf, 0.7}), Finding::worse);
  EXPECT_EQ(finding_of({kNaN, kNaN}, {0.8, 0.9}), Finding::better);
  EXPECT_NE(finding_of({kInf, kInf}, {-kInf, -kInf}), Finding::better);
  EXPECT_THAT(change_sentence(compared({0.9, 0.8}, {0.9, kNaN}).changes.at(0)),
              HasSubstr("no longer defined on 1 of 2 seeds"));
}

TEST(Comparison, OfATargetIsWorseOnBothSidesOfIt) {
  const auto run = [](double ratio) {
    return made_up_run({"a"}, {"lines_per_wall"}, 5, [&](const auto&, const auto&, std::uint64_t seed) {
      return ratio + 0.001 * static_cast<double>(seed);
    });
  };
  const Gates gates(study::GateSpec{{{"lines_per_wall", 0.05}}});
  ASSERT_EQ(gates.description("lines_per_wall").direction, metrics::Direction::target);
  const auto finding = [&](double before, double after) {
    const RunResults a = run(before);
    RunResults b = run(after);
    b.cells.back().rows.back().value += 1e-4;  // differences have some spread
    return compare(a, b, gates).changes.at(0).finding;
  };
  EXPECT_EQ(finding(1.0, 1.3), Finding::worse);
  EXPECT_EQ(finding(1.0, 0.4), Finding::worse);
  EXPECT_EQ(finding(0.4, 1.0), Finding::better);
  EXPECT_EQ(finding(0.8, 1.2), Finding::within);  // as far from 1 as before
}

TEST(Comparison, OfMetricsWithoutADirectionOrWithTimesIsNoGate) {
  const auto run = [](double factor, std::size_t seeds) {
    return made_up_run({"a"}, {"test_lines", "t_total"}, seeds, [&](const auto&, const auto&, std::uint64_t seed) {
      return factor * (10.0 + static_cast<double>(seed));
    });
  };
  const auto change = [](const Comparison& c, const std::string& metric) {
    return *std::ranges::find_if(c.changes, [&](const auto& entry) { return entry.metric.metric == metric; });
  };
  const Comparison nine = compare(run(1, 9), run(3, 9), Gates());
  ASSERT_TRUE(Gates().description("t_total").timing);
  EXPECT_EQ(change(nine, "test_lines").finding, Finding::changed);
  EXPECT_EQ(change(nine, "t_total").finding, Finding::worse);
  EXPECT_FALSE(change(nine, "t_total").gate);
  EXPECT_EQ(nine.exit_code(), 0);
  EXPECT_EQ(change(compare(run(1, 8), run(3, 8), Gates()), "t_total").finding, Finding::not_compared);
  RunResults elsewhere = run(3, 9);
  elsewhere.provenance.processor = "another";
  EXPECT_EQ(change(compare(run(1, 9), elsewhere, Gates()), "t_total").finding, Finding::not_compared);
  EXPECT_EQ(compare(run(1, 9), run(3, 9), Gates(study::GateSpec{{{"t_total", 0.0}}})).exit_code(), 1);  // asked for
}

TEST(Comparison, ACellThatFailsNowIsBrokenAndOneThatIsMissingMakesItIncomplete) {
  const RunResults good = f1_run({0.9, 0.8, 0.7});
  RunResults crashed = good;
  crashed.cells[1].status = "crashed";
  crashed.cells[1].message = "signal 11";
  crashed.cells[1].rows.clear();
  const Comparison broken = compare(good, crashed, Gates(kF1));
  EXPECT_EQ(broken.exit_code(), 1);
  EXPECT_THAT(verdict_sentence(broken), HasSubstr("1 cell is no longer ok. room/iepf/2 crashed: signal 11."));
  EXPECT_EQ(compare(crashed, good, Gates(kF1)).exit_code(), 0);
  EXPECT_EQ(compare(crashed, good, Gates(kF1)).mended.size(), 1U);
  const Comparison still = compare(crashed, crashed, Gates(kF1));
  EXPECT_EQ(still.failing.size(), 1U);
  EXPECT_EQ(still.exit_code(), 1);
  EXPECT_THAT(verdict_sentence(still), HasSubstr("FAIL: 1 cell is not ok, as before. room/iepf/2 crashed: signal 11."));

  const RunResults shorter = f1_run({0.9, 0.8});
  const Comparison missing = compare(good, shorter, Gates(kF1));
  EXPECT_EQ(missing.exit_code(), 4);
  EXPECT_THAT(verdict_sentence(missing), HasSubstr("INCOMPLETE: 1 cell is missing, first room/iepf/3."));
  const Comparison added = compare(shorter, good, Gates(kF1));
  EXPECT_EQ(added.exit_code(), 0);
  EXPECT_THAT(verdict_sentence(added), HasSubstr("1 cell is new and not compared."));

  RunResults both = crashed;
  both.cells.pop_back();
  EXPECT_EQ(compare(good, both, Gates(kF1)).exit_code(), 5);               // neither hides the other
  EXPECT_EQ(compare(RunResults{}, RunResults{}, Gates()).exit_code(), 2);  // nothing is never good
}

TEST(Comparison, AFailedCellOfANewPipelineFails) {
  const auto value = [](const auto&, const auto&, std::uint64_t) { return 0.9; };
  RunResults now = made_up_run({"iepf", "lt"}, {"f1"}, 2, value);
  for (auto& cell : now.cells)
    if (cell.key.pipeline == "lt") cell.status = "timeout";
  const Comparison c = compare(made_up_run({"iepf"}, {"f1"}, 2, value), now, Gates(kF1));
  EXPECT_EQ(c.exit_code(), 1);
  EXPECT_THAT(verdict_sentence(c), HasSubstr("FAIL: 2 new cells are not ok. room/lt/1 timeout: no message."));
}

TEST(Comparison, OfRunsWithoutACommonCellSaysThatNothingWasCompared) {
  const auto value = [](const auto&, const auto&, std::uint64_t) { return 0.9; };
  RunResults iepf = made_up_run({"iepf"}, {"f1"}, 2, value), lt = made_up_run({"lt"}, {"f1"}, 2, value);
  iepf.name = "one";
  lt.name = "other";
  const Comparison c = compare(iepf, lt, Gates(kF1));
  EXPECT_EQ(c.exit_code(), 2);
  EXPECT_EQ(verdict_sentence(c),
            "NOT COMPARED: no cell is in both runs, so nothing was compared: one has cells such as room/iepf/1, other "
            "has cells such as room/lt/1.");
  // A run that lacks its own cells is incomplete.
  RunResults gone = iepf;
  for (auto& cell : gone.cells) {
    cell.status = "missing";
    cell.requested = true;
  }
  EXPECT_EQ(compare(iepf, gone, Gates(kF1)).exit_code(), 4);
}

TEST(Comparison, AMetricWithoutRowsMakesItIncomplete) {
  RunResults without = f1_run({0.9, 0.8});
  for (auto& cell : without.cells) cell.rows.clear();
  const Comparison c = compare(f1_run({0.9, 0.8}), without, Gates(kF1));
  EXPECT_THAT(c.absent, ElementsAre("room/iepf: f1"));
  EXPECT_EQ(c.exit_code(), 4);
  EXPECT_THAT(verdict_sentence(c), HasSubstr("INCOMPLETE: 1 gate has no values any more, first room/iepf: f1."));
  EXPECT_EQ(compare(without, f1_run({0.9, 0.8}), Gates(kF1)).exit_code(), 0);  // a new metric
}

TEST(Comparison, AMetricThatIsNoGateNowIsSaidAndNotMissing) {
  const auto value = [](const auto&, const auto&, std::uint64_t) { return 0.9; };
  const RunResults before = made_up_run({"iepf", "lt"}, {"f1", "precision", "recall"}, 3, value);
  const Comparison c = compare(before, made_up_run({"iepf", "lt"}, {"f1"}, 3, value), Gates(kF1));
  EXPECT_EQ(c.exit_code(), 0);
  EXPECT_THAT(c.dropped, ElementsAre("precision", "recall"));
  EXPECT_EQ(
      verdict_sentence(c),
      "PASS: none of 2 gates is worse (2 equal to the bit). Not gates, and without values now: precision, recall.");
}

TEST(Comparison, OnlyHeadlinesFailAndTheSentenceCountsBothSides) {
  // f1 of a is better, that of b worse; precision and recall are watched.
  const auto run = [](double a, double b, double watched) {
    return made_up_run({"a", "b"}, {"f1", "precision", "recall"}, 4,
                       [=](const std::string& pipeline, const std::string& metric, std::uint64_t seed) {
                         const double spread = 0.001 * static_cast<double>(seed * seed) * a;
                         return (metric == "f1" ? (pipeline == "a" ? a : b) : watched) + spread;
                       });
  };
  const Comparison mixed = compare(run(0.7, 0.8, 0.9), run(0.8, 0.7, 0.6), Gates());
  EXPECT_EQ(mixed.gates, 2U);
  EXPECT_EQ(mixed.exit_code(), 1);
  EXPECT_THAT(verdict_sentence(mixed), HasSubstr("FAIL: 1 of 2 gates is worse, 1 is better. Worse: f1 of b in room"));
  EXPECT_THAT(verdict_sentence(mixed), HasSubstr("Of the watched metrics 4 are worse."));
  const Comparison watched = compare(run(0.7, 0.7, 0.9), run(0.8, 0.8, 0.6), Gates());
  EXPECT_EQ(watched.exit_code(), 0);
  EXPECT_THAT(verdict_sentence(watched), HasSubstr("PASS: none of 2 gates is worse, 2 are better. The best: "));
  EXPECT_THAT(verdict_sentence(watched), HasSubstr("Of the watched metrics 4 are worse."));
}

TEST(Gates, AreAtMostTwoHeadlinesOfTheLastStage) {
  const auto descriptions = metric_descriptions();
  std::set<std::string> all;
  for (const auto& [metric, description] : descriptions) {
    all.insert(metric);
    EXPECT_LE(Gates().among({metric}).size(), 1U);
    EXPECT_TRUE(!is_headline(metric) || description.direction != metrics::Direction::neither) << metric;
  }
  EXPECT_THAT(Gates().among(all), ElementsAre("covered_5cm", "true_share_5cm"));
  EXPECT_THAT(Gates().among({"f1", "recall", "raster_f1"}), ElementsAre("f1"));
  EXPECT_THAT(Gates().among({"f1", "pose_error_heading", "pose_error_position"}),
              ElementsAre("pose_error_heading", "pose_error_position"));
  EXPECT_THAT(Gates().among({"heading_error", "position_error", "rpe_position"}),
              ElementsAre("heading_error", "position_error"));
  EXPECT_THAT(Gates(study::GateSpec{{{"recall", 0.1}, {"t_total", 1.0}}}).among({"f1", "recall", "t_total"}),
              ElementsAre("recall", "t_total"));
}

TEST(Comparison, SaysWhatDiffers) {
  RunResults a = f1_run({0.9});
  RunResults b = a;
  b.provenance.commit = "def";
  a.settings["room"] = {{"pipelines.iepf.extract.params.threshold_m", "0.1"}, {"about", "a room"}};
  b.settings["room"] = {{"pipelines.iepf.extract.params.threshold_m", "0.2"}, {"about", "the room"}};
  a.cells[0].recording = "one";
  b.cells[0].recording = "two";
  EXPECT_THAT(compare(a, b, Gates()).differing,
              ElementsAre("commit: abc -> def", "room: pipelines.iepf.extract.params.threshold_m: 0.1 -> 0.2",
                          HasSubstr("scans of room/1")));
}

TEST(Comparison, DoesNotNameThePlaceOfACopyInTheRunAsADifference) {
  RunResults a = f1_run({0.9});
  RunResults b = a;
  a.settings["room"] = {{"published", "inputs/room/published.csv"}};
  b.settings["room"] = {{"published", "../inputs/room/published.csv"}};  // of a run with several scenarios
  EXPECT_THAT(compare(a, b, Gates()).differing, IsEmpty());
  b.settings["room"] = {{"published", "other.csv"}};
  EXPECT_EQ(compare(a, b, Gates()).differing.size(), 1U);
}

// Nights with other noise than the night before, so that every value differs and nothing has changed.
RunResults night(std::uint64_t number, double worse_by = 0.0) {
  return made_up_run({"a", "b", "c", "d"}, {"f1", "precision", "recall"}, 20,
                     [&](const std::string& pipeline, const std::string& metric, std::uint64_t seed) {
                       const auto stream = static_cast<std::uint32_t>(pipeline[0] * 16 + metric[0]);
                       CounterRng noise(number, RngStream::pose, static_cast<std::uint32_t>(seed), stream);
                       const bool is_worse = pipeline == "c" && metric == "recall";
                       return 0.9 + 0.01 * noise.normal() - (is_worse ? worse_by : 0.0);
                     });
}

TEST(Comparison, RaisesAnAlarmInAtMostOneNightOfTwentyWithoutAChange) {
  const Gates gates(study::GateSpec{{{"f1", 0.0}, {"precision", 0.0}, {"recall", 0.0}}});  // the test alone decides
  int alarms = 0;
  for (std::uint64_t n = 0; n < 200; ++n) alarms += compare(night(2 * n), night(2 * n + 1), gates).exit_code() != 0;
  EXPECT_LE(alarms, 10);
}

TEST(Comparison, FindsAMetricThatIsWorseByItsToleranceAndItsNoise) {
  const Gates gates(study::GateSpec{{{"f1", 0.005}, {"precision", 0.005}, {"recall", 0.005}}});
  int found = 0;
  for (std::uint64_t n = 0; n < 200; ++n) {
    // The tolerance, and the standard deviation of a difference of two nights.
    const Comparison c = compare(night(2 * n), night(2 * n + 1, 0.005 + 0.01 * std::sqrt(2.0)), gates);
    const auto worse = changes_with(c, Finding::worse);
    found += !worse.empty() && worse.front()->pipeline == "c" && worse.front()->metric.metric == "recall";
  }
  EXPECT_GE(found, 190);
}

// With skip = n, n more beams of each of the five frames have no line: test_unlabelled grows by 5 n; the tolerance
// is 1.
fs::path run_with_skip(const fs::path& out, std::int64_t skip, const std::vector<std::uint64_t>& seeds = {1, 2}) {
  run_here(
      {scenario_with("s", {extract_with("a", "test_line", {{"skip", skip}}), extract_with("b", "test_line")}, seeds)},
      {.out = out, .jobs = 2});
  return out;
}

Comparison compare_folders(const fs::path& a, const fs::path& b) {
  return compare(load_run_results(a), load_run_results(b), Gates(study::GateSpec{{{"test_unlabelled", 1.0}}}));
}

TEST(Comparison, OfRunFoldersPairsTheirCells) {
  const support::TemporaryFolder folder;
  const fs::path a = run_with_skip(folder.path() / "a", 0);
  const fs::path b = run_with_skip(folder.path() / "b", 1);
  const Comparison c = compare_folders(a, b);
  const auto worse = changes_with(c, Finding::worse, false);
  ASSERT_EQ(worse.size(), 1U);
  EXPECT_EQ(worse[0]->pipeline, "a");
  EXPECT_EQ(worse[0]->metric.metric, "test_unlabelled");
  EXPECT_EQ(worse[0]->difference.mean, 5.0);
  EXPECT_EQ(worse[0]->metric.tolerance, 1.0);
  EXPECT_EQ(c.exit_code(), 1);
  EXPECT_EQ(compare_folders(b, a).exit_code(), 0);
  EXPECT_THAT(compare_folders(a, a).differing, IsEmpty());
  EXPECT_THROW(compare_folders(a, folder.path()), ConfigError);
}

TEST(Comparison, OfTwoRunsWithTheSameSelectionIsComplete) {
  const support::TemporaryFolder folder;
  const auto run_only = [&](const char* name, const std::string& only) {
    run_here({scenario_with("s", {extract_with("a", "test_line"), extract_with("b", "test_line")}, {1, 2})},
             {.out = folder.path() / name, .only = {only}, .argv = {"scanbench", "run", "s.yaml", "--only", only}});
    return folder.path() / name;
  };
  const fs::path one = run_only("one", "a");
  const fs::path two = run_only("two", "s/a");
  const fs::path other = run_only("other", "b");
  EXPECT_EQ(compare_folders(one, two).exit_code(), 0);
  EXPECT_EQ(compare_folders(one, two).cells, 2U);
  EXPECT_EQ(compare_folders(one, other).exit_code(), 2);
  fs::remove_all(runs::cell_path(one, {"s", "a", 2}));
  fs::remove_all(runs::cell_path(two, {"s", "a", 2}));
  EXPECT_EQ(compare_folders(one, two).exit_code(), 4);  // requested, and missing in both
}

TEST(Comparison, SaysWhenTheRecordingsDiffer) {
  const support::TemporaryFolder folder;
  const fs::path a = run_with_skip(folder.path() / "a", 0);
  runs::RunServices other = fixtures::services();
  other.recording = [](const study::Scenario&, std::uint64_t seed, int) {
    return fixtures::random_recording(seed + 100, 5, 16, true);
  };
  const fs::path b = folder.path() / "b";
  runs::run_with({scenario_with("s", {extract_with("a", "test_line"), extract_with("b", "test_line")}, {1, 2})},
                 {.out = b}, other);
  EXPECT_THAT(compare_folders(a, b).differing, ::testing::Contains(HasSubstr("scans of s/1")));
}

}  // namespace
}  // namespace scanbench::results
