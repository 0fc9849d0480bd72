// raster_truth compared with values computed by hand, and with lines drawn and measured by brute force.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/contracts/line_raster.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"
#include "core/special_values.hpp"
#include "tests/metrics/made_up.hpp"

namespace scanbench::test {
namespace {

MadeUpRun map_of(const std::vector<Segment>& walls, const std::vector<Segment>& lines) {
  MadeUpRun run = make_run(ScanGeometry(), {});
  for (const Segment& s : walls) run.truth.walls.push_back({"", s});
  run.result.has_map = true;
  for (const Segment& s : lines) run.result.map.lines.push_back({.segment = s});
  return run;
}

TEST(RasterTruth, APerfectMapIsPerfect) {
  const auto rows =
      evaluate("raster_truth", map_of({{{0, 0}, {4, 0}}, {{4, 0}, {4, 3}}}, {{{4, 3}, {4, 0}}, {{4, 0}, {0, 0}}}));
  for (const char* metric : {"raster_precision", "raster_recall", "raster_f1"})
    EXPECT_EQ(row(rows, metric).value, 1.0) << metric;
  for (const char* metric : {"raster_chamfer", "raster_hausdorff95", "raster_hausdorff"})
    EXPECT_EQ(row(rows, metric).value, 0.0) << metric;
  // Both walls contain the pixel of their corner.
  expect_value(rows, "raster_pixels", "all", 401 + 301 - 1, 401 + 301 - 1);
}

TEST(RasterTruth, MeasuresDistancesInMetres) {
  // A line 3 cm beside the middle half of a wall of 4 m.
  const auto rows = evaluate("raster_truth", map_of({{{0, 0}, {4, 0}}}, {{{1, 0.03}, {3, 0.03}}}));
  expect_value(rows, "raster_precision", "all", 1.0, 201);
  // 4 pixels beyond each end are within sqrt(4^2 + 3^2) = 5 pixels.
  expect_value(rows, "raster_recall", "all", (201.0 + 2 * 4) / 401, 401);
  EXPECT_NEAR(row(rows, "raster_hausdorff").value, std::hypot(1.0, 0.03), 1e-12);
  double from_wall = 201 * 0.03;
  for (int i = 1; i <= 100; ++i) from_wall += 2 * std::hypot(0.01 * i, 0.03);
  EXPECT_NEAR(row(rows, "raster_chamfer").value, 0.5 * (0.03 + from_wall / 401), 1e-12);
  // 95 % of 401 pixels are 381: all but the outer 10 at each end.
  EXPECT_NEAR(row(rows, "raster_hausdorff95").value, std::hypot(0.90, 0.03), 1e-12);
}

TEST(RasterTruth, ALineFarFromAllWallsIsFalse) {
  const auto rows = evaluate("raster_truth", map_of({{{0, 0}, {4, 0}}}, {{{0, 0}, {4, 0}}, {{0, 2}, {4, 2}}}));
  expect_value(rows, "raster_precision", "all", 0.5, 2 * 401);
  expect_value(rows, "raster_recall", "all", 1.0, 401);
  EXPECT_NEAR(row(rows, "raster_f1").value, 2.0 / 3, 1e-12);
}

TEST(RasterTruth, WithoutAnyFoundLineNothingIsRight) {
  const auto rows = evaluate("raster_truth", map_of({{{0, 0}, {4, 0}}}, {}));
  expect_undefined(rows, "raster_precision");
  expect_value(rows, "raster_recall", "all", 0.0, 401);
  EXPECT_EQ(row(rows, "raster_f1").value, 0.0);
  expect_undefined(rows, "raster_chamfer");
  expect_undefined(rows, "raster_hausdorff");
}

TEST(RasterTruth, APartThatFewReturnsShowCanBeFoundButIsNotMissed) {
  // Beams at 90 degrees to a wall 5 m away: most of it gets one or two returns in 10 cm.
  MadeUpRun run = make_run(ScanGeometry(radians(-30), radians(0.5), 121), {{"far", {{5, -4}, {5, 4}}}});
  cast_frame(run, Pose2());
  add_line(run, 0, line_between({5, -2}, {5, 2}), {});
  const auto strict = evaluate("raster_truth", run);
  expect_value(strict, "raster_precision", "all", 1.0, 401);
  const auto all = evaluate("raster_truth", run, {{"min_hits_per_m", 1.0}});
  EXPECT_GT(row(all, "raster_pixels").value, 500);
  EXPECT_LT(row(strict, "raster_pixels").value, row(all, "raster_pixels").value);
}

TEST(RasterTruth, LinesOfScansArePlacedByThePoses) {
  MadeUpRun run = make_run(ScanGeometry(radians(-90), radians(0.1), 1801), {{"wall", {{3, -2}, {3, 2}}}});
  cast_frame(run, Pose2(1, 0, 0.2));
  find_all_lines(run, 0);
  EXPECT_EQ(row(evaluate("raster_truth", run), "raster_f1").value, 1.0) << "true poses, because there are no others";
  run.result.world_from_sensor = {Pose2(1, 0, 0.2)};
  EXPECT_EQ(row(evaluate("raster_truth", run), "raster_f1").value, 1.0);
  run.result.world_from_sensor = {Pose2(1.2, 0, 0.2)};
  const auto moved = evaluate("raster_truth", run);
  EXPECT_EQ(row(moved, "raster_f1").value, 0.0);
  EXPECT_NEAR(row(moved, "raster_hausdorff").value, 0.2, 0.01);
  // A map replaces them, unless the parameter says otherwise.
  run.result.has_map = true;
  run.result.map.lines.push_back({.segment = {{3, -2}, {3, 2}}});
  EXPECT_EQ(row(evaluate("raster_truth", run), "raster_f1").value, 1.0);
  EXPECT_EQ(row(evaluate("raster_truth", run, {{"found", std::string("scans")}}), "raster_f1").value, 0.0);
}

TEST(RasterTruth, NeedsWalls) {
  MadeUpRun run = map_of({{{0, 0}, {1, 0}}}, {});
  EXPECT_TRUE(family("raster_truth")->applies(run.input()));
  EXPECT_FALSE(family("raster_truth")->applies(run.input_without_truth()));
  run.truth.walls.clear();
  EXPECT_FALSE(family("raster_truth")->applies(run.input()));
}

TEST(RasterTruth, InCoordinatesOfAMapIsAsNearTheOrigin) {
  const std::vector<Segment> walls{{{0, 0}, {4, 0}}, {{4, 0}, {4, 3}}, {{1, 1}, {2.3, 2.9}}},
      lines{{{0.5, 0.02}, {3, 0.01}}, {{4.03, 0}, {4.08, 2}}, {{1, 1.2}, {2.3, 3.1}}};
  const auto moved_by = [](std::vector<Segment> segments, const Vec2& by) {
    for (Segment& s : segments) s = {s.a + by, s.b + by};
    return segments;
  };
  const auto near = evaluate("raster_truth", map_of(walls, lines));
  EXPECT_GT(row(near, "raster_precision").value, 0.1);
  EXPECT_LT(row(near, "raster_precision").value, 0.9);
  for (const Vec2& by : {Vec2(500000, 5000000), Vec2(1e7, 1e7), Vec2(-1e7, 3)}) {
    const auto far = evaluate("raster_truth", map_of(moved_by(walls, by), moved_by(lines, by)));
    ASSERT_EQ(far.size(), near.size());
    for (std::size_t k = 0; k < near.size(); ++k) EXPECT_EQ(far[k].value, near[k].value) << near[k].metric;
  }
}

TEST(RasterTruth, RefusesLinesThatItsPixelsCannotHold) {
  const auto error_of = [](const Segment& line, double resolution_m) -> std::string {
    try {
      evaluate("raster_truth", map_of({{{0, 0}, {1, 0}}}, {line}), {{"resolution_m", resolution_m}});
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(error_of({{0, 0}, {800, 800}}, 0.01), "");
  EXPECT_NE(error_of({{0, 0}, {0, 2e6}}, 0.01).find("raster_truth: lines of 2e+08 pixels of 0.01 m; allowed"),
            std::string::npos);
  EXPECT_NE(error_of({{5e4, 0}, {5e4, 1}}, 0.01).find("raster_truth: a line 5e+04 m from the origin"),
            std::string::npos);
  EXPECT_EQ(error_of({{5e4, 0}, {5e4, 1}}, 1.0), "");
}

// ---- brute force

std::set<Pixel> drawn(const std::vector<Segment>& lines, double pixel_m) {
  std::set<Pixel> pixels;
  for (const Segment& s : lines) {
    Vec2 a = s.a / pixel_m, b = s.b / pixel_m;
    const bool steep = std::fabs(b.y() - a.y()) > std::fabs(b.x() - a.x());
    const Eigen::Index u = steep ? 1 : 0, v = 1 - u;
    if (a[u] > b[u]) std::swap(a, b);
    for (int column = static_cast<int>(std::floor(a[u] + 0.5)); column <= static_cast<int>(std::floor(b[u] + 0.5));
         ++column) {
      const double at = a[v] + (column - a[u]) * (b[v] - a[v]) / (b[u] - a[u]);
      const auto across = static_cast<std::int32_t>(std::floor(at + 0.5));
      pixels.insert(steep ? Pixel{.y = column, .x = across} : Pixel{.y = across, .x = column});
    }
  }
  return pixels;
}

struct BruteForce {
  double near = 0, sum = 0, farthest = 0;
  BruteForce(const std::set<Pixel>& from, const std::set<Pixel>& to, double tolerance) {
    for (const Pixel& p : from) {
      double best = kInf;
      for (const Pixel& q : to) best = std::min(best, std::hypot(q.x - p.x, q.y - p.y));
      if (best <= tolerance) ++near;
      sum += best;
      farthest = std::max(farthest, best);
    }
  }
};

TEST(RasterTruth, AgreesWithBruteForceOnRandomMaps) {
  constexpr double kPixel = 0.01;
  for (std::uint32_t map = 0; map < 200; ++map) {
    CounterRng rng(7, RngStream::pose, map);
    const auto anywhere = [&] { return Vec2(3 * rng.uniform() - 1.5, 3 * rng.uniform() - 1.5); };
    std::vector<Segment> walls, lines;
    for (int i = 0; i < 6; ++i) {
      const Vec2 a = anywhere();
      const double angle = kTwoPi * rng.uniform();
      walls.push_back({a, a + 0.6 * rng.uniform() * Vec2(std::cos(angle), std::sin(angle))});
      const auto beside = [&](const Vec2& p) { return Vec2(p + 0.04 * Vec2(rng.normal(), rng.normal())); };
      if (i > 0) lines.push_back({beside(walls.back().a), beside(walls.back().b)});  // one is missed
    }
    lines.push_back({anywhere(), anywhere()});  // and one is false
    const auto rows = evaluate("raster_truth", map_of(walls, lines));

    const std::set<Pixel> found = drawn(lines, kPixel), truth = drawn(walls, kPixel);
    const BruteForce from_found(found, truth, 5.0), from_truth(truth, found, 5.0);
    const double n_found = static_cast<double>(found.size()), n_truth = static_cast<double>(truth.size());
    const double precision = from_found.near / n_found, recall = from_truth.near / n_truth;
    const double f1 = precision + recall > 0 ? 2 * precision * recall / (precision + recall) : 0.0;
    const double one_pixel = 1.0 / std::min(n_found, n_truth);
    EXPECT_NEAR(row(rows, "raster_precision").value, precision, one_pixel) << "map " << map;
    EXPECT_NEAR(row(rows, "raster_recall").value, recall, one_pixel) << "map " << map;
    EXPECT_NEAR(row(rows, "raster_f1").value, f1, one_pixel) << "map " << map;
    const double farthest = std::max(from_found.farthest, from_truth.farthest);
    EXPECT_NEAR(row(rows, "raster_hausdorff").value, kPixel * farthest, 0.5 * kPixel) << "map " << map;
    EXPECT_NEAR(row(rows, "raster_chamfer").value, 0.5 * kPixel * (from_found.sum / n_found + from_truth.sum / n_truth),
                kPixel * farthest * one_pixel)
        << "map " << map;
  }
}

}  // namespace
}  // namespace scanbench::test
