// siadat1997 compared with sums written by hand.
#include "core/special_values.hpp"
#include "made_up.hpp"

namespace scanbench::test {
namespace {

/// Frames of 7 beams whose points are on x = 1 (beam 0 looks along x, further ones at 0.1 rad steps), moved outwards
/// along x by the given residuals.
MadeUpRun points_near_x1(const std::vector<std::vector<double>>& residuals) {
  const ScanGeometry geometry(0.0, 0.1, 7);
  MadeUpRun run = make_run(geometry, {});
  for (const auto& frame : residuals) {
    std::vector<double> ranges;
    for (std::size_t i = 0; i < frame.size(); ++i)
      ranges.push_back((1.0 + frame[i]) / geometry.direction(static_cast<int>(i)).x());
    add_frame(run, {}, ranges, std::vector<std::int32_t>(7, -1));
  }
  return run;
}

TEST(Siadat1997, ResidualsAreAveragedOverSegmentsFirstAndScansThen) {
  const double out = kNaN;
  MadeUpRun run = points_near_x1({{0.03, -0.01, 0.02, 0.08, -0.04, 0.0, 0.0}, {0.06, 0.0, 0.0, out, 0.0, 0.0, 0.0}});
  // Scan 0: |0.03|, |0.01|, |0.02| -> mean 0.02, max 0.03; two points -> 0, 0; two free points.
  add_line(run, 0, polar_line(1, 0), {0, 1, 2});
  add_line(run, 0, polar_line(1, 0), {3, 4});
  // Scan 1: 0.06, 0, 0 -> mean 0.02, max 0.06; beam 3 has no return, so its line has no point -> 0;
  // 3 points on the line -> 0.
  add_line(run, 1, polar_line(1, 0), {0, 1, 2});
  add_line(run, 1, polar_line(1, 0), {3});
  add_line(run, 1, polar_line(1, 0), {4, 5, 6});
  const auto rows = evaluate("siadat1997", run);
  expect_value(rows, "s_min", "all", 2, 2);
  expect_value(rows, "s_mean", "all", 2.5, 2);
  expect_value(rows, "s_max", "all", 3, 2);
  expect_value(rows, "d_mean", "all", ((0.02 + 0.0) / 2 + (0.02 + 0.0 + 0.0) / 3) / 2, 2);
  expect_value(rows, "d_max", "all", ((0.03 + 0.0) / 2 + (0.06 + 0.0 + 0.0) / 3) / 2, 2);
  expect_value(rows, "d_mean_pts", "all", (0.06 / 5 + 0.06 / 6) / 2, 2);
  expect_value(rows, "d_max_scan", "all", (0.03 + 0.06) / 2, 2);
  EXPECT_EQ(row(rows, "d_mean").unit, "m");
}

TEST(Siadat1997, ScansWithoutSegmentsCountForTheNumbersButNotForTheResiduals) {
  MadeUpRun run = points_near_x1({{0.03, 0, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 0, 0}});
  add_line(run, 0, polar_line(1, 0), {0, 1, 2});
  const auto rows = evaluate("siadat1997", run);
  expect_value(rows, "s_min", "all", 0, 2);
  expect_value(rows, "s_mean", "all", 0.5, 2);
  expect_value(rows, "d_mean", "all", 0.01, 1);
  expect_value(rows, "d_max", "all", 0.03, 1);
}

TEST(Siadat1997, TimesAreMillisecondsPerScanOfTheThreeStages) {
  MadeUpRun run = points_near_x1({{0, 0, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 0, 0}});
  run.result.times = {{"extract", Stage::pre, 0, 1e-3},     {"extract", Stage::segment, 0, 2e-3},
                      {"extract", Stage::pre, 1, 3e-3},     {"extract", Stage::segment, 1, 4e-3},
                      {"extract", Stage::segment, 1, 2e-3}, {"merge", {}, -1, 9.0}};
  const auto rows = evaluate("siadat1997", run);
  expect_value(rows, "t_pre", "all", 2.0, 2);
  expect_value(rows, "t_seg", "all", (2.0 + 6.0) / 2, 2);
  expect_value(rows, "t_post", "all", 0.0, 2);  // line tracking has no fit after its grouping
  expect_value(rows, "t_total", "all", (3.0 + 9.0) / 2, 2);
  run.result.times.push_back({"extract", Stage::fit, 1, 1e-3});
  expect_value(evaluate("siadat1997", run), "t_post", "all", 0.5, 2);
  for (const auto& d : family("siadat1997")->describe()) EXPECT_EQ(d.timing, d.metric.starts_with("t_")) << d.metric;
}

TEST(Siadat1997, EveryStageOfAnExtractorIsInOnePartAndInTheTotal) {
  MadeUpRun run = points_near_x1({{0, 0, 0, 0, 0, 0, 0}});
  double total = 0.0;
  for (std::size_t i = 0; i < stage_names().size(); ++i) {
    const double ms = static_cast<double>(std::size_t{1} << i);  // every sum of different stages is another number
    run.result.times.push_back({"extract", static_cast<Stage>(i), 0, 1e-3 * ms});
    total += ms;
  }
  run.result.times.push_back({"extract", std::nullopt, 0, 1e-3 * 0.5});  // a module that names no stages
  const auto rows = evaluate("siadat1997", run);
  EXPECT_NEAR(row(rows, "t_total").value, total + 0.5, 1e-9);
  expect_value(rows, "t_pre", "all", 1.0, 1);
  expect_value(rows, "t_seg", "all", 2.0 + 4.0 + 0.5, 1);  // segment and search
  EXPECT_NEAR(row(rows, "t_pre").value + row(rows, "t_seg").value + row(rows, "t_post").value, total + 0.5, 1e-9);
}

TEST(Siadat1997, APolygonTakes48BytesASegmentAgainst4ABeam) {
  MadeUpRun run = points_near_x1({{0, 0, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 0, 0}});
  add_line(run, 0, polar_line(1, 0), {0, 1, 2});
  add_line(run, 0, polar_line(1, 0), {3, 4});
  add_line(run, 1, polar_line(1, 0), {0, 1, 2});
  const auto rows = evaluate("siadat1997", run);
  expect_value(rows, "polygon_bytes", "all", 3 * 48 / 2.0, 2);
  expect_value(rows, "compression", "all", 2 * 7 * 4 / (3 * 48.0), 2);
}

TEST(Siadat1997, NeedsNoTruthAndSurvivesAnEmptyRun) {
  MadeUpRun run = make_run(ScanGeometry(0.0, 0.1, 7), {});
  EXPECT_TRUE(family("siadat1997")->applies(run.input_without_truth()));
  const auto rows = family("siadat1997")->evaluate(run.input_without_truth());
  EXPECT_EQ(rows.size(), 13u);
  for (const auto& r : rows) expect_undefined(rows, r.metric);
}

}  // namespace
}  // namespace scanbench::test
