// timing compared with sums and medians computed by hand.
#include "made_up.hpp"

namespace scanbench::test {
namespace {

TEST(Timing, IsTheMedianOverTheScansOfTheSumOfTheStagesOfExtraction) {
  MadeUpRun run;
  // Scans of 3, 10 and 4 us; matching and what belongs to no scan do not count.
  run.result.times = {{"extract", Stage::pre, 0, 1e-6},
                      {"extract", Stage::segment, 0, 2e-6},
                      {"extract", Stage::pre, 1, 9e-6},
                      {"extract", Stage::fit, 1, 1e-6},
                      {"extract", {}, 2, 4e-6},
                      {"match", {}, 2, 5.0},
                      {"align", {}, -1, 7.0}};
  const auto t = row(evaluate("timing", run), "t_scan");
  EXPECT_NEAR(t.value, 4.0, 1e-9);
  EXPECT_EQ(t.unit, "us");
  EXPECT_EQ(t.count, 3);
  run.result.times.push_back({"extract", {}, 3, 6e-6});  // 3, 4, 6, 10
  EXPECT_NEAR(row(evaluate("timing", run), "t_scan").value, 5.0, 1e-9);
}

TEST(Timing, OfAnAlignmentIsTheSumOfItsStages) {
  MadeUpRun run;
  run.result.times = {
      {"extract", {}, 0, 1e-6}, {"align", Stage::resample, -1, 2e-3}, {"align", Stage::simulate, -1, 3e-3}};
  EXPECT_NEAR(row(evaluate("timing", run), "t_align").value, 5000.0, 1e-9);
}

TEST(Timing, DoesNotApplyToARunThatWasNotTimed) {
  MadeUpRun run;
  EXPECT_FALSE(family("timing")->applies(run.input()));
  run.result.times = {{"align", {}, -1, 7.0}, {"merge", Stage::match, 0, 1.0}};
  EXPECT_FALSE(family("timing")->applies(run.input()));
  run.result.times.push_back({"extract", {}, 0, 1e-6});
  EXPECT_TRUE(family("timing")->applies(run.input_without_truth()));
}

}  // namespace
}  // namespace scanbench::test
