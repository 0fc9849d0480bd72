// map_growth compared with counts and medians by hand.
#include "made_up.hpp"

namespace scanbench::test {
namespace {

MadeUpRun mapped() {
  MadeUpRun run;
  run.result.has_map = true;
  for (int k = 0; k < 3; ++k) run.result.map.lines.push_back({.segment = {{0, 0}, {1, 0}}});
  // Scans of 1, 2, 4 and 6 ms.
  run.result.times = {{"map", Stage::match, 0, 0.4e-3},
                      {"map", Stage::merge, 0, 0.6e-3},
                      {"map", {}, 1, 2e-3},
                      {"map", {}, 2, 4e-3},
                      {"map", {}, 3, 6e-3},
                      {"extract", {}, 0, 9.0}};
  return run;
}

TEST(MapGrowth, CountsLinesEndPointsAndMillisecondsPerScan) {
  const MadeUpRun run = mapped();
  const auto rows = evaluate("map_growth", run);
  EXPECT_EQ(row(rows, "grown_lines").value, 3);
  EXPECT_EQ(row(rows, "grown_end_points").value, 6);
  EXPECT_NEAR(row(rows, "t_map").value, 3.0, 1e-9);
  EXPECT_EQ(row(rows, "t_map").count, 4);
  EXPECT_NEAR(row(rows, "t_map_growth").value, 5.0 / 1.5, 1e-9);
}

TEST(MapGrowth, AppliesToMapsThatAreMadeScanByScan) {
  MadeUpRun run = mapped();
  EXPECT_TRUE(family("map_growth")->applies(run.input_without_truth()));
  run.result.times = {{"merge", {}, -1, 1.0}};
  EXPECT_FALSE(family("map_growth")->applies(run.input()));
  MadeUpRun without = mapped();
  without.result.has_map = false;
  EXPECT_FALSE(family("map_growth")->applies(without.input()));
}

}  // namespace
}  // namespace scanbench::test
