// borges2000 compared with sums written by hand.
#include "core/rng.hpp"
#include "core/special_values.hpp"
#include "made_up.hpp"

namespace scanbench::test {
namespace {

const std::vector<Wall> kTwoWalls{{"east", {{2, -9}, {2, 9}}}, {"north", {{9, 3}, {-9, 3}}}};  // (2, 0) and (3, 90 deg)

/// Frames of 6 beams, the first four from wall 0 and the last two from wall 1, all at 1 m.
MadeUpRun six_beams(std::vector<Wall> walls, int frames, const Pose2& pose = {}) {
  MadeUpRun run = make_run(ScanGeometry(0.0, 0.1, 6), std::move(walls));
  const std::vector<double> ranges(6, 1.0);
  const std::vector<std::int32_t> ids{0, 0, 0, 0, 1, 1};
  for (int f = 0; f < frames; ++f) add_frame(run, pose, ranges, ids);
  return run;
}

TEST(Borges2000, AveragesOverTheScansWithALineAndPoolsErrorsOverTheValidOnes) {
  MadeUpRun run = six_beams(kTwoWalls, 3);
  add_line(run, 0, polar_line(2.1, 2), {0, 1});
  add_line(run, 0, polar_line(2.2, 4), {2, 3});
  add_line(run, 0, polar_line(3.05, 93), {4, 5});
  add_line(run, 1, polar_line(2.7, 0), {0, 1, 2, 3});  // rho off by 0.7 m: invalid
  add_line(run, 2, polar_line(2.0, 1), {0, 1, 2, 3});
  const auto rows = evaluate("borges2000", run);

  expect_value(rows, "n_lines", "east", (2 + 1 + 1) / 3.0, 3);
  expect_value(rows, "eta", "east", (1 + 0 + 1) / 3.0, 3);
  expect_value(rows, "eps_rho", "east", (0.1 + 0.2 + 0.0) / 3.0, 3);
  expect_value(rows, "eps_alpha", "east", (2 + 4 + 1) / 3.0, 3);
  expect_value(rows, "missed", "east", 0.0, 3);
  expect_value(rows, "n_lines", "north", 1.0, 1);  // not (1 + 0 + 0) / 3
  expect_value(rows, "eta", "north", 1.0, 1);
  expect_value(rows, "eps_rho", "north", 0.05, 1);
  expect_value(rows, "eps_alpha", "north", 3.0, 1);
  expect_value(rows, "missed", "north", 2.0 / 3.0, 3);
  expect_value(rows, "n_lines", "mean", (4.0 / 3.0 + 1.0) / 2.0, 2);
  expect_value(rows, "eps_rho", "mean", (0.1 + 0.05) / 2.0, 2);
  expect_value(rows, "eps_alpha", "mean", (7.0 / 3.0 + 3.0) / 2.0, 2);
  expect_value(rows, "missed", "mean", (0.0 + 2.0 / 3.0) / 2.0, 2);
  expect_value(rows, "spurious", "all", 0.0, 5);
  EXPECT_EQ(row(rows, "eps_rho", "east").unit, "m");
  EXPECT_EQ(row(rows, "eps_alpha", "east").unit, "deg");
}

TEST(Borges2000, ALineAcrossTwoWallsBelongsToTheMoreSimilarOneOnly) {
  // 45 deg differs by 45 deg from both walls; rho decides: |2.2 - 2| / 0.5 = 0.4 against |2.2 - 3| / 0.5 = 1.6.
  MadeUpRun run = six_beams(kTwoWalls, 1);
  add_line(run, 0, polar_line(2.2, 45), {3, 4, 5});
  const auto rows = evaluate("borges2000", run);
  expect_value(rows, "n_lines", "east", 1.0, 1);
  expect_value(rows, "eta", "east", 0.0, 1);
  expect_undefined(rows, "eps_rho", "east");
  expect_undefined(rows, "n_lines", "north");
  expect_value(rows, "missed", "north", 1.0, 1);
}

TEST(Borges2000, SimilarityScalesRhoByHalfAMetreAndAlphaByTwentyDegrees) {
  // Walls a (2, 0 deg) and b (rho, 10 deg), line (2, 10 deg): (10/20)^2 = 0.25 to a, ((rho - 2)/0.5)^2 to b.
  const auto winner = [](double rho) {
    const PolarLine second{rho, radians(10)};
    const Vec2 foot = second.rho * second.normal();
    const Vec2 along = perpendicular(second.normal());
    MadeUpRun run = six_beams({{"a", {{2, -9}, {2, 9}}}, {"b", {foot - along, foot + along}}}, 1);
    add_line(run, 0, polar_line(2.0, 10), {3, 4, 5});
    return row(evaluate("borges2000", run), "n_lines", "a").count == 1 ? "a" : "b";
  };
  EXPECT_STREQ(winner(2.4), "a");  // 0.64
  EXPECT_STREQ(winner(2.2), "b");  // 0.16
}

TEST(Borges2000, BetweenEquallySimilarWallsTheSupportDecides) {
  MadeUpRun run = six_beams({{"a", {{2, 0}, {2, 1}}}, {"b", {{2, 1}, {2, 2}}}}, 2);
  add_line(run, 0, polar_line(2.0, 0), {3, 4, 5});     // one point of a, two of b
  add_line(run, 1, polar_line(2.0, 0), {2, 3, 4, 5});  // two of each: the lower index
  const auto rows = evaluate("borges2000", run);
  expect_value(rows, "missed", "a", 0.5, 2);
  expect_value(rows, "missed", "b", 0.5, 2);
  expect_value(rows, "n_lines", "a", 1.0, 1);
}

TEST(Borges2000, AWallThatTheLinesPointsDoNotComeFromIsNoCandidate) {
  MadeUpRun run = six_beams(kTwoWalls, 1);
  add_line(run, 0, polar_line(3.0, 90), {0, 1});  // is on north, but its points are on east
  const auto rows = evaluate("borges2000", run);
  expect_value(rows, "eta", "east", 0.0, 1);
  expect_undefined(rows, "n_lines", "north");
}

TEST(Borges2000, LinesOnNoWallAreSpuriousAndSinglePointsAreIgnored) {
  MadeUpRun run = make_run(ScanGeometry(0.0, 0.1, 6), kTwoWalls);
  add_frame(run, {}, std::vector<double>(6, 1.0), std::vector<std::int32_t>{0, 0, -1, -1, -1, 1});
  add_line(run, 0, polar_line(2, 0), {0, 1});
  add_line(run, 0, polar_line(2, 0), {2, 3});
  add_line(run, 0, polar_line(2, 0), {4});
  add_line(run, 0, polar_line(3, 90), {5});
  const auto rows = evaluate("borges2000", run);
  expect_value(rows, "spurious", "all", 1.0, 2);
  expect_value(rows, "n_lines", "east", 1.0, 1);
  expect_undefined(rows, "n_lines", "north");
  expect_undefined(rows, "missed", "north");  // a single point: no extractor can find the wall
}

TEST(Borges2000, LinesNearTheOriginAndAtTheSeamOfTheCircleAreNotDeclaredInvalid) {
  // Wall 0 is y = 0 (rho = 0, alpha = 90 deg), wall 1 is x = -2 (alpha = 180 deg).
  MadeUpRun run = six_beams({{"axis", {{-9, 0}, {9, 0}}}, {"west", {{-2, 9}, {-2, -9}}}}, 2);
  add_line(run, 0, polar_line(0.01, -90), {0, 1, 2, 3});  // y = -0.01
  add_line(run, 0, polar_line(2.02, -179), {4, 5});
  add_line(run, 1, polar_line(0.01, 92), {0, 1, 2, 3});
  add_line(run, 1, polar_line(2.0, 179), {4, 5});
  const auto rows = evaluate("borges2000", run);
  expect_value(rows, "eta", "axis", 1.0, 2);
  expect_value(rows, "eps_rho", "axis", 0.01, 2);
  expect_value(rows, "eps_alpha", "axis", 1.0, 2);
  expect_value(rows, "eta", "west", 1.0, 2);
  expect_value(rows, "eps_rho", "west", 0.01, 2);
  expect_value(rows, "eps_alpha", "west", 1.0, 2);
}

TEST(Borges2000, ErrorsAreInTheWorldFrameUnlessTheSensorFrameIsRequested) {
  // Seen from (0, 10) the wall x = 2 is (2, 0). A line (2, 1 deg) there is (2 + 10 sin 1 deg, 1 deg) in the world.
  MadeUpRun run = six_beams(kTwoWalls, 1, Pose2(0, 10, 0));
  add_line(run, 0, polar_line(2.0, 1), {0, 1});
  expect_value(evaluate("borges2000", run), "eps_rho", "east", 10 * std::sin(radians(1.0)), 1);
  const auto in_sensor = evaluate("borges2000", run, {{"frame", std::string("sensor")}});
  expect_value(in_sensor, "eps_rho", "east", 0.0, 1);
  expect_value(in_sensor, "eps_alpha", "east", 1.0, 1);
}

TEST(Borges2000, LostReturnsDoNotMakeAWallMissed) {
  MadeUpRun run = six_beams(kTwoWalls, 1);
  for (const std::size_t i : {0, 1, 2}) run.observed.frames[0].ranges[i] = kInf;
  expect_undefined(evaluate("borges2000", run), "missed", "east");  // one return of four
}

TEST(Borges2000, TheMeasuresOfRandomLinesStayWithinTheirBounds) {
  MadeUpRun run = six_beams(kTwoWalls, 200);
  CounterRng rng(7, RngStream::resampling);
  for (std::size_t f = 0; f < 200; ++f) {
    std::vector<std::vector<int>> beams(3);
    for (int i = 0; i < 6; ++i) beams[rng.bits() % 3].push_back(i);
    for (const auto& b : beams) add_line(run, f, polar_line(4 * rng.uniform(), 360 * rng.uniform()), b);
  }
  const auto rows = evaluate("borges2000", run);
  for (const auto& r : rows) {
    if (r.metric == "spurious") continue;
    ASSERT_TRUE(std::isfinite(r.value)) << r.metric;
    const double limit = r.metric == "n_lines"     ? 3.0
                         : r.metric == "eps_rho"   ? 0.5
                         : r.metric == "eps_alpha" ? 20.0
                                                   : 1.0;
    EXPECT_GE(r.value, r.metric == "n_lines" ? 1.0 : 0.0) << r.metric;
    EXPECT_LE(r.value, limit) << r.metric;
  }
  EXPECT_LT(row(rows, "eta", "mean").value, 0.5);  // the lines are random, so most are invalid
}

TEST(Borges2000, WithoutLinesOrFramesEveryRowIsThereAndUndefined) {
  const MadeUpRun run = make_run(ScanGeometry(0.0, 0.1, 6), kTwoWalls);
  const auto rows = evaluate("borges2000", run);
  EXPECT_EQ(rows.size(), 5u * 3u + 1u);
  for (const char* metric : {"n_lines", "eta", "eps_rho", "eps_alpha", "missed"})
    for (const char* subject : {"east", "north", "mean"}) expect_undefined(rows, metric, subject);
  expect_value(rows, "spurious", "all", 0.0, 0);
}

TEST(Borges2000, DoesNotApplyWithoutTruth) {
  const MadeUpRun run = six_beams(kTwoWalls, 1);
  EXPECT_TRUE(family("borges2000")->applies(run.input()));
  EXPECT_FALSE(family("borges2000")->applies(run.input_without_truth()));
}

TEST(Borges2000, WallsWithoutALabelOfTheirOwnGetTheirIndex) {
  const MadeUpRun run = six_beams({{"w", {{2, 0}, {2, 1}}}, {"w", {{3, 0}, {3, 1}}}, {"", {{4, 0}, {4, 1}}}}, 1);
  const auto rows = evaluate("borges2000", run);
  for (const char* subject : {"w#0", "w#1", "#2"}) expect_undefined(rows, "n_lines", subject);
}

}  // namespace
}  // namespace scanbench::test
