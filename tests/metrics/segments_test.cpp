// segments: perfect lines, and small errors with a known effect.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "core/index.hpp"
#include "core/rng.hpp"
#include "core/special_values.hpp"
#include "made_up.hpp"
#include "metrics/line_matching.hpp"

namespace scanbench::test {
namespace {

using metrics::join_walls;

const std::vector<Wall> kRoom{{"south", {{-3, -2}, {3, -2}}},
                              {"east", {{3, -2}, {3, 2}}},
                              {"north", {{3, 2}, {-3, 2}}},
                              {"west", {{-3, 2}, {-3, -2}}}};

/// 360 beams all around, starting in the corner of south and west, so that no wall is cut by the first beam.
const ScanGeometry kAllAround(std::atan2(-2.0, -3.0) + 1e-4, radians(1.0), 360);

MadeUpRun room_from_the_middle() {
  MadeUpRun run = make_run(kAllAround, kRoom);
  cast_frame(run, {});
  return run;
}

std::vector<int> beams_of(const MadeUpRun& run, int wall) {
  std::vector<int> beams;
  for (std::size_t i = 0; i < run.truth.wall_ids.size(); ++i)
    if (run.truth.wall_ids[i] == wall) beams.push_back(static_cast<int>(i));
  return beams;
}

Vec2 true_point(const MadeUpRun& run, int beam) {
  return run.truth.ranges[as_index(beam)] * run.observed.sensor.geometry.direction(beam);
}

TEST(Segments, PerfectLinesScorePerfectly) {
  MadeUpRun run = make_run(kAllAround, kRoom);
  cast_frame(run, {});
  cast_frame(run, Pose2(1.0, 0.5, 0.3));
  find_all_lines(run, 0);
  find_all_lines(run, 1);
  const auto rows = evaluate("segments", run);
  const auto found = static_cast<std::int64_t>(run.result.lines[0].lines.size() + run.result.lines[1].lines.size());
  EXPECT_GE(found, 8);
  for (const char* metric : {"precision", "recall", "overlap"}) expect_value(rows, metric, "all", 1.0, found);
  expect_value(rows, "f1", "all", 1.0, 2 * found);
  for (const char* metric : {"split", "merged", "sigma_offset", "sigma_angle"})
    expect_value(rows, metric, "all", 0.0, found);
}

TEST(Segments, CountsOneOfEachKind) {
  MadeUpRun run = room_from_the_middle();
  const auto south = beams_of(run, 0);
  const auto east = beams_of(run, 1);
  const auto at = [&](const std::vector<int>& beams, double share) {
    const Vec2 a = true_point(run, beams.front());
    return Vec2(a + share * (true_point(run, beams.back()) - a));
  };
  // South in two pieces of 60 % and 40 %, east as a whole, a line through the room, a short piece; no line on north and
  // west.
  add_line(run, 0, line_between(at(south, 0.0), at(south, 0.6)), {});
  add_line(run, 0, line_between(at(south, 0.6), at(south, 1.0)), {});
  add_line(run, 0, line_between(at(east, 0.0), at(east, 1.0)), {});
  add_line(run, 0, line_between({-1, 0}, {1, 0.5}), {});
  add_line(run, 0, line_between({0, 0}, {0.3, 0.3}), {});
  const auto rows = evaluate("segments", run);
  expect_value(rows, "n_true", "all", 2, 4);
  expect_value(rows, "n_split", "all", 1, 4);
  expect_value(rows, "n_false", "all", 1, 4);
  expect_value(rows, "n_missed", "all", 2, 4);
  expect_value(rows, "precision", "all", 2.0 / 4, 4);
  expect_value(rows, "recall", "all", 2.0 / 4, 4);
  expect_value(rows, "f1", "all", 0.5, 8);
  expect_value(rows, "split", "all", 1.0 / 4, 4);
  expect_value(rows, "overlap", "all", (0.6 + 1.0) / 2, 2);
}

TEST(Segments, TheTableOfScansCountsEachScanForItself) {
  MadeUpRun run = room_from_the_middle();
  cast_frame(run, {});
  cast_frame(run, {});
  const auto south = beams_of(run, 0);
  // Scan 0: nothing found. Scan 1: the south wall, 3 cm off, and a line through the room. Scan 2: all of them.
  const Vec2 up(0, 0.03);
  std::vector<int> beams;
  for (const int beam : south)
    if (beam < 360) beams.push_back(beam);
  add_line(run, 1, line_between(true_point(run, beams.front()) + up, true_point(run, beams.back()) + up), beams);
  add_line(run, 1, line_between({-1, 0}, {1, 0.5}), {});
  find_all_lines(run, 2);
  const auto tables = Registry<metrics::MetricFamily>::make("segments")->tables(run.input());
  ASSERT_EQ(tables.size(), 1U);
  EXPECT_EQ(tables[0].name, "scans");
  EXPECT_EQ(tables[0].columns, (std::vector<std::string>{"frame", "true", "false", "missed", "split", "merged", "f1",
                                                         "residual_m", "small"}));
  ASSERT_EQ(tables[0].rows.size(), 3U);
  const auto begins_with = [&](std::size_t row, std::vector<double> counts) {
    EXPECT_EQ(std::vector(tables[0].rows[row].begin(), tables[0].rows[row].begin() + 7), counts);
  };
  begins_with(0, {0, 0, 0, 4, 0, 0, 0});
  EXPECT_TRUE(std::isnan(tables[0].rows[0][7]));  // no return supports a line
  begins_with(1, {1, 1, 1, 3, 0, 0, 2.0 * 1 / (2 + 4)});
  EXPECT_NEAR(tables[0].rows[1][7], 0.03, 1e-12);
  begins_with(2, {2, 4, 0, 0, 0, 0, 1});
  EXPECT_NEAR(tables[0].rows[2][7], 0, 1e-12);
}

TEST(Segments, RightLinesOnWallsTooSmallToCountAreNeitherTrueNorFalse) {
  // A wall, and 0.45 m of another one, 1 m apart in depth.
  MadeUpRun run = make_run(ScanGeometry(radians(10), radians(0.5), 320),
                           {{"wall", {{0.0, 2.5}, {-2.0, 2.5}}}, {"post", {{0.95, 1.5}, {0.5, 1.5}}}});
  cast_frame(run, {});
  add_line(run, 0, line_between({0.0, 2.5}, {-2.0, 2.5}), {});
  add_line(run, 0, line_between({0.99, 1.5}, {0.47, 1.5}), {});
  add_line(run, 0, line_between({0.99, 1.9}, {0.47, 1.9}), {});
  const auto rows = evaluate("segments", run);
  expect_value(rows, "n_true", "all", 1, 2);
  expect_value(rows, "n_false", "all", 1, 2);
  expect_value(rows, "n_small", "all", 1, 3);
  expect_value(rows, "precision", "all", 1.0 / 2, 2);
  expect_value(rows, "f1", "all", 2.0 / 3, 3);
  expect_value(rows, "precision_strict", "all", 1.0 / 3, 3);
  expect_value(rows, "f1_strict", "all", 2.0 / 4, 4);
}

// A stretch of a wall that neighbouring beams of one frame see.
struct SeenPiece {
  Segment segment;
  int beams = 0;
  bool judged() const { return beams >= 9 && segment.length() >= 0.5; }
};

std::vector<SeenPiece> pieces_by_hand(const MadeUpRun& run) {
  std::vector<SeenPiece> pieces;
  for (std::size_t i = 0; i < run.truth.wall_ids.size(); ++i) {
    if (run.truth.wall_ids[i] < 0) continue;
    const Vec2 p = true_point(run, static_cast<int>(i));
    if (i == 0 || run.truth.wall_ids[i] != run.truth.wall_ids[i - 1]) pieces.push_back({{p, p}, 0});
    pieces.back().segment.b = p;
    ++pieces.back().beams;
  }
  std::erase_if(pieces, [](const SeenPiece& piece) { return piece.beams < 3; });
  return pieces;
}

// The length that a found line shares with a piece, 0 if they do not match.
double shared_length(const Segment& found, const Segment& piece) {
  const Vec2 u = (piece.b - piece.a).normalized();
  const double length = (piece.b - piece.a).norm();
  const double p = u.dot(found.a - piece.a), q = u.dot(found.b - piece.a);
  const double cosine = std::fabs(u.dot((found.b - found.a).normalized()));
  const Vec2 to_middle = 0.5 * (found.a + found.b) - piece.a;
  const double off = (to_middle - u.dot(to_middle) * u).norm();
  const double common = std::min(length, std::max(p, q)) - std::max(0.0, std::min(p, q));
  const bool match =
      cosine >= std::cos(radians(10)) && off <= 0.15 && common > 0.5 * std::min(length, std::fabs(p - q));
  return match ? std::max(0.0, common) : 0.0;
}

// Which lines get a piece of their own, the pair with the most in common first.
std::vector<bool> matched_by_hand(const std::vector<Segment>& lines, const std::vector<SeenPiece>& pieces) {
  std::vector<bool> line_done(lines.size(), false), piece_done(pieces.size(), false);
  while (true) {
    double most = 0.0;
    std::size_t line = 0, piece = 0;
    for (std::size_t k = 0; k < lines.size(); ++k)
      for (std::size_t t = 0; t < pieces.size(); ++t)
        if (const double shared = shared_length(lines[k], pieces[t].segment);
            !line_done[k] && !piece_done[t] && shared > most)
          most = shared, line = k, piece = t;
    if (most == 0.0) return line_done;
    line_done[line] = piece_done[piece] = true;
  }
}

TEST(Segments, ScoresAreThoseOfTheDefinitionInRandomRoomsWithSmallWalls) {
  double small_in_all = 0, false_in_all = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    CounterRng rng(seed, RngStream::pose);
    const auto between = [&](double low, double high) { return low + (high - low) * rng.uniform(); };
    std::vector<Wall> walls = kRoom;
    for (int i = 0; i < 12; ++i) {
      const double bearing = kTwoPi * rng.uniform(), turn = kPi * rng.uniform(), half = between(0.1, 0.6);
      const Vec2 middle = between(0.8, 1.8) * Vec2(std::cos(bearing), std::sin(bearing));
      const Vec2 along = half * Vec2(std::cos(turn), std::sin(turn));
      walls.push_back({"post " + std::to_string(i), {middle - along, middle + along}});
    }
    MadeUpRun run = make_run(ScanGeometry(-kPi + 1e-4, radians(3.0), 120), walls);
    cast_frame(run, {});
    const std::vector<SeenPiece> pieces = pieces_by_hand(run);
    std::vector<Segment> lines;
    for (const SeenPiece& piece : pieces)
      for (int copy = 0; copy < 2; ++copy) {  // stretched, cut, turned and moved
        const Vec2 middle = piece.segment.midpoint(), half = 0.5 * (piece.segment.b - piece.segment.a);
        const Eigen::Rotation2Dd turn(radians(between(-9, 9)));
        const Vec2 off = between(0, 0.2) * Vec2(-half.y(), half.x()).normalized();
        const Vec2 reach = between(0.4, 1.6) * (turn * half);
        lines.push_back({middle + off - reach, middle + off + reach});
      }
    for (const Segment& s : lines) add_line(run, 0, line_between(s.a, s.b), {});

    std::vector<SeenPiece> truths, small;
    for (const SeenPiece& piece : pieces) (piece.judged() ? truths : small).push_back(piece);
    const std::vector<bool> right = matched_by_hand(lines, truths);
    std::vector<Segment> rest;
    double n_true = 0, n_split = 0;
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const bool near_truth = std::ranges::any_of(
          truths, [&](const SeenPiece& truth) { return shared_length(lines[k], truth.segment) > 0; });
      n_true += right[k] ? 1 : 0;
      n_split += near_truth && !right[k] ? 1 : 0;
      if (!near_truth && lines[k].length() >= 0.5) rest.push_back(lines[k]);
    }
    const std::vector<bool> excused = matched_by_hand(rest, small);
    const auto n_small = static_cast<double>(std::ranges::count(excused, true));
    const double n_false = static_cast<double>(rest.size()) - n_small, n_truth = static_cast<double>(truths.size());
    small_in_all += n_small, false_in_all += n_false;

    const auto rows = evaluate("segments", run);
    const auto value = [&](const char* metric) { return row(rows, metric).value; };
    EXPECT_EQ(value("n_true"), n_true) << "seed " << seed;
    EXPECT_EQ(value("n_split"), n_split) << "seed " << seed;
    EXPECT_EQ(value("n_small"), n_small) << "seed " << seed;
    EXPECT_EQ(value("n_false"), n_false) << "seed " << seed;
    const double found = n_true + n_false + n_split;
    EXPECT_NEAR(value("precision"), n_true / found, 1e-12);
    EXPECT_NEAR(value("f1"), 2 * n_true / (found + n_truth), 1e-12);
    EXPECT_NEAR(value("precision_strict"), n_true / (found + n_small), 1e-12);
    EXPECT_NEAR(value("f1_strict"), 2 * n_true / (found + n_small + n_truth), 1e-12);
    const auto scans = family("segments")->tables(run.input()).at(0);
    EXPECT_NEAR(scans.rows[0][6], value("f1"), 1e-12);
    EXPECT_EQ(scans.rows[0][8], n_small);
  }
  EXPECT_GT(small_in_all, 30);
  EXPECT_GT(false_in_all, 30);
}

TEST(Segments, ErrorsAreRootMeanSquaresAtTheFoundLinesMidpoint) {
  MadeUpRun run = room_from_the_middle();
  const auto south = beams_of(run, 0);
  const auto north = beams_of(run, 2);
  const Vec2 up(0, 0.03);
  add_line(run, 0, line_between(true_point(run, south.front()) + up, true_point(run, south.back()) + up), {});
  // North rotated by 2 deg about its midpoint and moved by 4 cm.
  const Vec2 middle = 0.5 * (true_point(run, north.front()) + true_point(run, north.back())) + Vec2(0, 0.04);
  const Vec2 half = Pose2(0, 0, radians(2)).rotate({-2.5, 0});
  add_line(run, 0, line_between(middle - half, middle + half), {});
  const auto rows = evaluate("segments", run);
  expect_value(rows, "sigma_offset", "all", std::sqrt((0.03 * 0.03 + 0.04 * 0.04) / 2), 2);
  expect_value(rows, "sigma_angle", "all", std::sqrt((0.0 + 2.0 * 2.0) / 2), 2);
}

TEST(Segments, EachConditionOfAMatchCanFailAlone) {
  const auto score = [](const Vec2& a, const Vec2& b) {
    MadeUpRun run = room_from_the_middle();
    add_line(run, 0, line_between(a, b), {});
    return row(evaluate("segments", run), "n_true").value;
  };
  const Vec2 half_9deg = Pose2(0, 0, radians(9)).rotate({1, 0});
  const Vec2 half_11deg = Pose2(0, 0, radians(11)).rotate({1, 0});
  const Vec2 on_south(0, -2);
  EXPECT_EQ(score(on_south - half_9deg, on_south + half_9deg), 1);
  EXPECT_EQ(score(on_south + half_9deg, on_south - half_9deg), 1);  // direction does not matter
  EXPECT_EQ(score(on_south - half_11deg, on_south + half_11deg), 0);
  EXPECT_EQ(score({-1, -2.14}, {1, -2.14}), 1);
  EXPECT_EQ(score({-1, -2.16}, {1, -2.16}), 0);
  EXPECT_EQ(score({1.9, -2}, {3.9, -2}), 1);  // more than half of its 2 m on south, which ends within 4 cm of 3
  EXPECT_EQ(score({2.1, -2}, {4.1, -2}), 0);
}

TEST(Segments, OneLineOverTwoWallsIsMergedTrueForTheLongerOverlapAndMissesTheOther) {
  // Two collinear walls with a gap of 0.4 m, 2 m and 1.2 m long, in front of a sensor 1.5 m away.
  MadeUpRun run = make_run(ScanGeometry(radians(10), radians(0.5), 320),
                           {{"left", {{0.2, 1.5}, {-1.0, 1.5}}}, {"right", {{2.6, 1.5}, {0.6, 1.5}}}});
  cast_frame(run, {});
  add_line(run, 0, line_between({2.6, 1.5}, {-1.0, 1.5}), {});
  const auto rows = evaluate("segments", run);
  expect_value(rows, "n_true", "all", 1, 1);
  expect_value(rows, "n_merged", "all", 1, 1);
  expect_value(rows, "merged", "all", 1.0, 1);
  expect_value(rows, "n_missed", "all", 1, 2);
  expect_value(rows, "precision", "all", 1.0, 1);
  EXPECT_NEAR(row(rows, "overlap").value, 2.0 / 3.6,
              0.02);  // the ends of the true line are up to a beam inside those of the wall
}

TEST(Segments, WallsThatContinueEachOtherAreOneTrueLine) {
  MadeUpRun run = make_run(ScanGeometry(radians(10), radians(0.5), 320),
                           {{"left", {{0.6, 1.5}, {-1.0, 1.5}}}, {"right", {{2.6, 1.5}, {0.6, 1.5}}}});
  cast_frame(run, {});
  add_line(run, 0, line_between(true_point(run, beams_of(run, 1).front()), true_point(run, beams_of(run, 0).back())),
           {});
  const auto rows = evaluate("segments", run);
  for (const char* metric : {"precision", "recall", "overlap"}) expect_value(rows, metric, "all", 1.0, 1);
  expect_value(rows, "n_merged", "all", 0, 1);
}

TEST(Segments, LostReturnsDoNotCutATrueLineButABodyInFrontDoes) {
  MadeUpRun run = make_run(ScanGeometry(radians(45), radians(1), 91), {{"north", {{5, 2}, {-5, 2}}}});
  cast_frame(run, {});
  for (std::size_t i = 0; i < 91; i += 4) run.observed.frames[0].ranges[i] = kInf;
  expect_value(evaluate("segments", run), "n_missed", "all", 1, 1);
  for (std::size_t i = 40; i < 50; ++i) run.truth.wall_ids[i] = -1;
  expect_value(evaluate("segments", run), "n_missed", "all", 2, 2);
  // One line across the body is true for one piece and misses the other; it is not merged, because the wall is one.
  add_line(run, 0, line_between({2, 2}, {-2, 2}), {});
  expect_value(evaluate("segments", run), "n_missed", "all", 1, 2);
  expect_value(evaluate("segments", run), "n_merged", "all", 0, 1);
}

TEST(Segments, TrueLinesHaveAtLeastNineReturnsAndHalfAMetre) {
  // Beams 1 deg apart on a wall 4 m away: neighbours about 7 cm apart; 9 beams reach 0.56 m, 8 only 0.49 m.
  const auto truths = [](int beams, const ParamSet& params, int lost = 0) {
    MadeUpRun run =
        make_run(ScanGeometry(radians(90 - 0.5 * (beams - 1)), radians(1), beams), {{"n", {{5, 4}, {-5, 4}}}});
    cast_frame(run, {});
    for (int i = 0; i < lost; ++i) run.observed.frames[0].ranges[as_index(2 + i)] = 0.0;
    return row(evaluate("segments", run, params), "n_missed").value;
  };
  EXPECT_EQ(truths(9, {}), 1);
  EXPECT_EQ(truths(11, {}, 2), 1);
  EXPECT_EQ(truths(11, {}, 3), 0);
  EXPECT_EQ(truths(8, {{"min_length_m", 0.4}}), 0);
  EXPECT_EQ(truths(8, {{"min_length_m", 0.4}, {"min_beams", std::int64_t{8}}}), 1);
  EXPECT_EQ(truths(8, {{"min_beams", std::int64_t{8}}}), 0);
}

TEST(Segments, WithoutLinesRecallIsZeroAndPrecisionUndefined) {
  const MadeUpRun run = room_from_the_middle();
  const auto rows = evaluate("segments", run);
  expect_value(rows, "recall", "all", 0.0, 4);
  expect_value(rows, "f1", "all", 0.0, 4);
  for (const char* metric : {"precision", "split", "merged", "sigma_offset", "sigma_angle", "overlap"})
    expect_undefined(rows, metric);
}

TEST(Segments, AnEmptyRunHasAllRowsAndTruthIsNeeded) {
  const MadeUpRun run = make_run(kAllAround, kRoom);
  const auto rows = evaluate("segments", run);
  EXPECT_EQ(rows.size(), family("segments")->describe().size());
  for (const char* metric : {"precision", "recall", "f1", "sigma_offset"}) expect_undefined(rows, metric);
  EXPECT_FALSE(family("segments")->applies(run.input_without_truth()));
}

TEST(Surfaces, JoinTouchingAndOverlappingCollinearWallsOnly) {
  const auto surfaces = join_walls(std::vector<Wall>{{"long", {{0, 0}, {4, 0}}},
                                                     {"inside", {{2, 0}, {1, 0}}},
                                                     {"across the corner", {{4, 0}, {4, 1}}},
                                                     {"beyond", {{6, 0}, {4, 0}}},
                                                     {"after a gap", {{6.1, 0}, {7, 0}}},
                                                     {"parallel", {{0, 0.01}, {4, 0.01}}}});
  EXPECT_EQ(surfaces.of_wall, (std::vector<int>{0, 0, 1, 0, 2, 3}));
  EXPECT_EQ(surfaces.segments[0], (Segment{{0, 0}, {6, 0}}));
}

// The definition, pair by pair, with sets merged by relabelling.
std::vector<int> surfaces_by_hand(const std::vector<Wall>& walls) {
  const auto join = [](const Segment& s, const Segment& t) {
    const bool s_longer = s.length() >= t.length();
    const Segment& base = s_longer ? s : t;
    const Segment& other = s_longer ? t : s;
    const Vec2 u = (base.b - base.a) / base.length(), v = (other.b - other.a) / other.length();
    const Vec2 middle = 0.5 * (other.a + other.b) - base.a;
    const double a = u.dot(other.a - base.a), b = u.dot(other.b - base.a);
    return std::fabs(cross(u, v)) <= std::sin(radians(0.1)) && std::fabs(cross(u, middle)) <= 1e-3 &&
           std::min(a, b) <= base.length() + 1e-3 && std::max(a, b) >= -1e-3;
  };
  std::vector<int> set(walls.size());
  for (std::size_t i = 0; i < walls.size(); ++i) {
    set[i] = static_cast<int>(i);
    for (std::size_t j = 0; j < i; ++j)
      if (set[j] != set[i] && join(walls[i].segment, walls[j].segment)) {
        const int from = std::max(set[i], set[j]), to = std::min(set[i], set[j]);
        std::ranges::replace(set, from, to);
      }
  }
  std::map<int, int> number;  // sets in the order of their first walls
  for (int& s : set) s = number.try_emplace(s, static_cast<int>(number.size())).first->second;
  return set;
}

TEST(Surfaces, AreThoseOfTheDefinitionInRandomWorlds) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    CounterRng rng(seed, RngStream::pose);
    const auto below = [&](int n) { return static_cast<int>(rng.uniform() * n); };
    // Few lines, and ends that touch, overlap or just miss: every limit is met from both sides.
    std::vector<Wall> walls;
    const double turn = kTwoPi * rng.uniform(), size = seed % 2 == 0 ? 1.0 : 100.0;
    for (int i = 0; i < 150; ++i) {
      const double y = below(4) + 4e-4 * below(6), tilt = radians(0.04) * below(5);
      const double x = size * 0.25 * below(16) + 4e-4 * below(5), length = size * 0.25 * (1 + below(4));
      const Vec2 a(x, y), b = a + length * Vec2(std::cos(tilt), std::sin(tilt));
      const Eigen::Rotation2Dd rotation(turn + (below(2) == 0 ? kPi / 2 : 0.0));
      walls.push_back({std::to_string(i), {rotation * a, rotation * b}});
      if (below(2) == 0) std::swap(walls.back().segment.a, walls.back().segment.b);
    }
    const auto surfaces = join_walls(walls);
    EXPECT_EQ(surfaces.of_wall, surfaces_by_hand(walls)) << "seed " << seed;
  }
}

TEST(Surfaces, ThePiecesOfACurveStayApart) {
  std::vector<Wall> arc;
  for (int i = 0; i < 90; ++i)
    arc.push_back(
        {"", {{std::cos(radians(i)), std::sin(radians(i))}, {std::cos(radians(i + 1)), std::sin(radians(i + 1))}}});
  EXPECT_EQ(join_walls(arc).segments.size(), 90u);
}

}  // namespace
}  // namespace scanbench::test
