// map_truth compared with values computed by hand.
#include "core/special_values.hpp"
#include "made_up.hpp"

namespace scanbench::test {
namespace {

/// Walls without scans, all of them visible, and a map.
MadeUpRun map_of(std::vector<Wall> walls, const std::vector<Segment>& lines) {
  MadeUpRun run = make_run(ScanGeometry(), std::move(walls));
  run.result.has_map = true;
  for (const Segment& s : lines) {
    run.result.map.lines.emplace_back();
    run.result.map.lines.back().segment = s;
  }
  return run;
}

const std::vector<Wall> kCorner{{"a", {{0, 0}, {4, 0}}}, {"b", {{4, 0}, {4, 3}}}};

TEST(MapTruth, APerfectMapIsPerfect) {
  const auto rows = evaluate("map_truth", map_of(kCorner, {{{4, 0}, {0, 0}}, {{4, 0}, {4, 3}}}));
  for (const char* metric : {"covered_5cm", "covered_10cm", "true_share_5cm", "true_share_10cm", "lines_per_wall"})
    expect_value(rows, metric, "all", 1.0, 2);
  for (const char* metric : {"duplicates", "fragments", "unassigned", "map_offset", "map_angle"})
    expect_value(rows, metric, "all", 0.0, 2);
  expect_value(rows, "visible_m", "all", 7.0, 2);
}

TEST(MapTruth, CoverageExtendsPastTheEndsOfALine) {
  // A line 3 cm beside a, from x = 1 to 3: the wall from 1 - 0.04 to 3 + 0.04 is within 5 cm of it.
  const auto rows = evaluate("map_truth", map_of(kCorner, {{{1, 0.03}, {3, 0.03}}}));
  expect_value(rows, "covered_5cm", "all", 2.08 / 7, 2);
  expect_value(rows, "covered_10cm", "all", (2 + 2 * std::sqrt(0.01 - 0.0009)) / 7, 2);
  expect_value(rows, "true_share_5cm", "all", 1.0, 1);
  expect_value(rows, "lines_per_wall", "all", 0.5, 2);
  expect_value(rows, "map_offset", "all", 0.03, 1);
}

TEST(MapTruth, ALineAcrossAWallCoversNothingAndIsTrueOnlyWhereTheyCross) {
  const auto rows = evaluate("map_truth", map_of(kCorner, {{{2, -1}, {2, 1}}}));
  expect_value(rows, "covered_10cm", "all", 0.0, 2);
  expect_value(rows, "true_share_5cm", "all", 0.1 / 2, 1);
  expect_value(rows, "true_share_10cm", "all", 0.2 / 2, 1);
  expect_value(rows, "unassigned", "all", 1.0, 1);
  expect_undefined(rows, "map_offset");
}

TEST(MapTruth, DistinguishesDuplicatesFromFragments) {
  // Wall a as [0, 2.5] and [2.5, 4], and once more [0.5, 1.5]; b as a whole.
  const auto rows = evaluate(
      "map_truth",
      map_of(kCorner, {{{0, 0}, {2.5, 0}}, {{2.5, 0.02}, {4, 0.02}}, {{0.5, 0.04}, {1.5, 0.04}}, {{4, 0}, {4, 3}}}));
  expect_value(rows, "duplicates", "all", 1.0, 4);
  expect_value(rows, "fragments", "all", 1.0, 4);
  expect_value(rows, "lines_per_wall", "all", 4.0 / 2, 2);
  expect_value(rows, "map_offset", "all", (0.02 * 1.5 + 0.04 * 1.0) / (2.5 + 1.5 + 1.0 + 3.0), 4);
}

TEST(MapTruth, AnglesAreWeightedByLength) {
  const Vec2 half = 0.5 * Vec2(std::cos(radians(3)), std::sin(radians(3)));
  const auto rows = evaluate("map_truth", map_of(kCorner, {{Vec2(2, 0) + half, Vec2(2, 0) - half}, {{4, 0}, {4, 3}}}));
  expect_value(rows, "map_angle", "all", 3.0 * 1.0 / (1.0 + 3.0), 2);
}

TEST(MapTruth, WallsThatContinueEachOtherMayShareALine) {
  const std::vector<Wall> walls{{"left", {{0, 0}, {2, 0}}}, {"right", {{2, 0}, {4, 0}}}};
  const auto joined = evaluate("map_truth", map_of(walls, {{{0, 0}, {4, 0}}}));
  expect_value(joined, "lines_per_wall", "all", 1.0, 1);
  expect_value(joined, "covered_5cm", "all", 1.0, 1);
  const auto apart = evaluate("map_truth", map_of(walls, {{{0, 0}, {2, 0}}, {{2, 0}, {4, 0}}}));
  expect_value(apart, "fragments", "all", 1.0, 2);
}

TEST(MapTruth, TheGapThatALineFillsIsFalse) {
  // Collinear walls with a gap: 1 m of the map is across the door, of which 5 cm at each side are near a wall.
  const std::vector<Wall> corridor{{"left", {{0, 0}, {2, 0}}}, {"right", {{3, 0}, {5, 0}}}};
  const auto rows = evaluate("map_truth", map_of(corridor, {{{0, 0}, {5, 0}}}));
  expect_value(rows, "true_share_5cm", "all", (5 - (1 - 2 * 0.05)) / 5, 1);
}

/// A run of one frame without beams and one map line, into which all lines of the frame were merged.
MadeUpRun merged_into_one(std::vector<Wall> walls, const std::vector<Segment>& members, const Segment& line) {
  MadeUpRun run = map_of(std::move(walls), {line});
  run.observed.frames.emplace_back();
  run.truth.world_from_sensor.emplace_back();
  run.result.lines.emplace_back();
  for (const Segment& s : members) {
    run.result.merge_labels.push_back({.frame = 0, .line = static_cast<int>(run.result.merge_labels.size())});
    run.result.merge_labels.back().map_line = 0;
    run.result.lines[0].lines.push_back(line_between(s.a, s.b));
  }
  return run;
}

double over_merged(const MadeUpRun& run) {
  return row(evaluate("map_truth", run), "over_merged").value;
}

TEST(MapTruth, ALineHalfwayBetweenTwoWallsIsOverMergedHoweverFarTheyAreApart) {
  const auto between_walls = [](double gap) {
    const Segment front{{0, 0}, {4, 0}};
    const Segment back{{0, gap}, {4, gap}};
    return over_merged(
        merged_into_one({{"front", front}, {"back", back}}, {front, back}, {{0, gap / 2}, {4, gap / 2}}));
  };
  for (const double gap : {0.16, 0.18, 0.30, 1.0}) EXPECT_EQ(between_walls(gap), 1) << gap;
  EXPECT_EQ(between_walls(0.14), 0);
}

TEST(MapTruth, OverMergingNeedsAFifthOfTheMembersFromEachWall) {
  const Segment front{{0, 0}, {4, 0}};
  const Segment back{{0, 0.3}, {4, 0.3}};
  std::vector<Segment> members{front, front, front, front, back};  // one of five
  EXPECT_EQ(over_merged(merged_into_one({{"front", front}, {"back", back}}, members, front)), 1);
  members.push_back(front);  // one of six
  EXPECT_EQ(over_merged(merged_into_one({{"front", front}, {"back", back}}, members, front)), 0);
}

TEST(MapTruth, CollinearWallsMayShareALineAndCrossingOnesAreNoOverMerging) {
  const Segment left{{0, 0}, {2, 0}};
  const Segment right{{3, 0}, {5, 0}};
  const Segment up{{3, 0}, {3, 2}};
  EXPECT_EQ(over_merged(merged_into_one({{"left", left}, {"right", right}}, {left, right}, {{0, 0}, {5, 0}})), 0);
  EXPECT_EQ(over_merged(merged_into_one({{"left", left}, {"up", up}}, {left, up}, {{0, 0}, {3, 1}})), 0);
}

TEST(MapTruth, ThePiecesOfAWallWithDoorsCountTogetherForOverMerging) {
  // Six pieces of the front have one of eight members each, the back behind the doors two: a quarter.
  std::vector<Wall> walls{{"back", {{0, 0.2}, {12, 0.2}}}};
  std::vector<Segment> members(2, walls[0].segment);
  for (int i = 0; i < 6; ++i) {
    walls.push_back({"front", {{2.0 * i, 0}, {2.0 * i + 1, 0}}});
    members.push_back(walls.back().segment);
  }
  EXPECT_EQ(over_merged(merged_into_one(walls, members, {{0, 0.05}, {12, 0.05}})), 1);
  members.erase(members.begin());  // one of seven
  EXPECT_EQ(over_merged(merged_into_one(walls, members, {{0, 0.05}, {12, 0.05}})), 0);
}

TEST(MapTruth, TheBeamsOfAMemberSayWhichWallItIsOn) {
  // Beams 0 to 3 see the near wall, 4 to 7 the far one, 8 neither.
  MadeUpRun run = make_run(ScanGeometry(0.0, 0.1, 9), {{"near", {{1, -9}, {1, 9}}}, {"far", {{1.5, -9}, {1.5, 9}}}});
  add_frame(run, {}, std::vector<double>(9, 1.0), std::vector<std::int32_t>{0, 0, 0, 0, 1, 1, 1, 1, -1});
  run.result.has_map = true;
  run.result.map.lines.resize(1);
  run.result.map.lines[0].segment = {{1, 0}, {1, 1}};
  // Both lines are nearest to the near wall; the second one has most of its beams on the far wall.
  add_line(run, 0, line_between({1, 0}, {1, 1}), {0, 1, 2});
  add_line(run, 0, line_between({1, 0}, {1, 1}), {3, 4, 5, 8});
  run.result.merge_labels = {{.frame = 0, .line = 0, .map_line = 0}, {.frame = 0, .line = 1, .map_line = 0}};
  EXPECT_EQ(over_merged(run), 1);
  run.result.merge_labels[1].map_line = -1;  // dropped
  EXPECT_EQ(over_merged(run), 0);
}

TEST(MapTruth, OverMergingIsUndefinedWithoutMembers) {
  expect_undefined(evaluate("map_truth", map_of(kCorner, {{{0, 0}, {4, 0}}})), "over_merged");
  expect_value(evaluate("map_truth", map_of(kCorner, {})), "over_merged", "all", 0.0, 0);
}

/// The wall y = 0 from x = -5 to 5, seen from 1 m above (0.5, 0) over 90 deg: x = -0.5 .. 1.5.
MadeUpRun seen_from_above(double step_deg) {
  MadeUpRun run =
      make_run(ScanGeometry(radians(-135 + 1e-6), radians(step_deg), 1 + static_cast<int>(90 / step_deg - 1e-3)),
               {{"floor", {{-5, 0}, {5, 0}}}});
  cast_frame(run, Pose2(0.5, 1.0, 0.0));
  run.result.has_map = true;
  run.result.map.lines.emplace_back();
  run.result.map.lines.back().segment = {{0, 0}, {1, 0}};
  return run;
}

TEST(MapTruth, OnlyWhatWasSeenOftenEnoughCounts) {
  const auto rows = evaluate("map_truth", seen_from_above(0.1));
  expect_value(rows, "visible_m", "all", 2.0, 1);
  expect_value(rows, "covered_5cm", "all", 1.1 / 2.0, 1);
  // At 4 deg the nearest returns are 7 cm apart: nowhere 3 in 10 cm, unless the scan is repeated.
  MadeUpRun sparse = seen_from_above(4.0);
  const auto unseen = evaluate("map_truth", sparse);
  expect_value(unseen, "visible_m", "all", 0.0, 0);
  expect_undefined(unseen, "covered_5cm");
  expect_undefined(unseen, "lines_per_wall");
  expect_value(unseen, "true_share_5cm", "all", 1.0, 1);
  for (int i = 0; i < 2; ++i) cast_frame(sparse, Pose2(0.5, 1.0, 0.0));
  EXPECT_GT(row(evaluate("map_truth", sparse), "visible_m").value, 1.0);
}

TEST(MapTruth, LostReturnsMakeNothingVisible) {
  MadeUpRun run = seen_from_above(0.1);
  for (double& r : run.observed.frames[0].ranges) r = kInf;
  expect_value(evaluate("map_truth", run), "visible_m", "all", 0.0, 0);
}

TEST(MapTruth, OneLineForEachVisiblePartIsNoFragment) {
  MadeUpRun run = seen_from_above(0.1);
  cast_frame(run, Pose2(-3.5, 1.0, 0.0));  // sees x = -4.5 .. -2.5, 2 m apart from the other part
  run.result.map.lines.emplace_back();
  run.result.map.lines.back().segment = {{-4, 0}, {-3, 0}};
  expect_value(evaluate("map_truth", run), "fragments", "all", 0.0, 2);
  run.result.map.lines.back().segment = {{1.1, 0}, {1.4, 0}};
  run.truth.wall_ids.resize(run.truth.wall_ids.size() / 2);
  run.truth.ranges.resize(run.truth.wall_ids.size());
  run.truth.world_from_sensor.pop_back();
  run.observed.frames.pop_back();
  run.result.lines.pop_back();
  expect_value(evaluate("map_truth", run), "fragments", "all", 1.0, 2);
}

TEST(MapTruth, AnEmptyMapCoversNothing) {
  const auto rows = evaluate("map_truth", map_of(kCorner, {}));
  EXPECT_EQ(rows.size(), family("map_truth")->describe().size());
  expect_value(rows, "covered_5cm", "all", 0.0, 2);
  for (const char* metric : {"true_share_5cm", "map_offset", "map_angle"}) expect_undefined(rows, metric);
}

TEST(MapTruth, NeedsTruthAndAMap) {
  const MadeUpRun run = map_of(kCorner, {{{0, 0}, {4, 0}}});
  EXPECT_TRUE(family("map_truth")->applies(run.input()));
  EXPECT_FALSE(family("map_truth")->applies(run.input_without_truth()));
  MadeUpRun no_slot_makes_one = map_of(kCorner, {});
  EXPECT_TRUE(family("map_truth")->applies(no_slot_makes_one.input()));  // an empty map covers nothing: a zero
  no_slot_makes_one.result.has_map = false;
  EXPECT_FALSE(family("map_truth")->applies(no_slot_makes_one.input()));
}

}  // namespace
}  // namespace scanbench::test
