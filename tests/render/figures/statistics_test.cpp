// The figures of statistics on values whose picture is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/geometry/angles.hpp"
#include "core/registry.hpp"
#include "core/special_values.hpp"
#include "render/figure.hpp"
#include "render/layout/layout.hpp"

namespace scanbench::render {
namespace {

MeasuredPipeline measured(const std::string& name, const std::map<std::string, std::vector<double>>& values,
                          double threshold = 0.0) {
  MeasuredPipeline m{
      .pipeline = name, .slots = {{"extract some", {{"threshold_m", threshold}}}}, .units = {}, .metrics = {}};
  m.by_seed = values;
  for (const auto& [metric, all] : values)
    for (const double v : all)
      if (std::isfinite(v)) m.metrics[metric].push_back(v);
  for (const auto& [metric, all] : m.metrics) {
    double sum = 0.0;
    for (const double v : all) sum += v;
    const auto [low, high] = std::ranges::minmax(all);
    m.bands[metric] = {sum / static_cast<double>(all.size()), low, high};
  }
  return m;
}

const Recording kNoRecording{};

FigureInput input_of(std::vector<MeasuredPipeline> pipelines) {
  FigureInput input{.title = "t", .recording = kNoRecording, .waypoints = {}, .results = {}};
  input.measured = std::move(pipelines);
  input.looks = {{"f1", {.best = MetricLook::Best::highest, .tolerance = 0.005}},
                 {"error", {.unit = "m", .best = MetricLook::Best::lowest, .tolerance = 0.001}},
                 {"n", {}},
                 {"scan_time", {.label = "CPU time of one scan", .unit = "s", .best = MetricLook::Best::lowest}}};
  input.quality = "f1";
  return input;
}

Scene scene_of(const std::string& figure, const FigureInput& input, const ParamSet& params = {}) {
  const auto scenes = Registry<Figure>::make(figure, params)->draw(input);
  if (scenes.size() != 1) {
    ADD_FAILURE() << figure << " drew " << scenes.size()
                  << " scenes: " << Registry<Figure>::make(figure, params)->why_nothing(input);
    return {.panels = {Panel{}, Panel{}}};
  }
  return scenes.front().scene;
}

template <class Kind>
std::vector<Kind> items(const Scene& scene, std::size_t panel = 0) {
  std::vector<Kind> found;
  for (const Item& item : scene.panels.at(panel).items)
    if (const Kind* kind = std::get_if<Kind>(&item)) found.push_back(*kind);
  return found;
}

TEST(AccuracyTime, TheFrontGoesThroughThePipelinesThatNoneBeats) {
  const auto input =
      input_of({measured("slow_bad", {{"f1", {0.4}}, {"scan_time", {30}}}),
                measured("slow_good", {{"f1", {0.9}}, {"scan_time", {40}}}),
                measured("fast", {{"f1", {0.5}}, {"scan_time", {10}}}), measured("untimed", {{"f1", {1.0}}})});
  const Scene scene = scene_of("accuracy_time", input);
  const auto stairs = items<Polyline>(scene);
  ASSERT_EQ(stairs.size(), 1u);
  EXPECT_EQ(stairs[0].points, (std::vector<Vec2>{{10, 0.5}, {40, 0.5}, {40, 0.9}}));
  EXPECT_EQ(items<Points>(scene).size(), 3u);
}

TEST(AccuracyTime, TheFrontOfAnErrorGoesDown) {
  const auto input = input_of({measured("a", {{"error", {0.4}}, {"scan_time", {10}}}),
                               measured("b", {{"error", {0.1}}, {"scan_time", {20}}}),
                               measured("c", {{"error", {0.2}}, {"scan_time", {20}}})});
  const Scene scene = scene_of("accuracy_time", input, {{"metric", std::string("error")}});
  EXPECT_EQ(items<Polyline>(scene).at(0).points, (std::vector<Vec2>{{10, 0.4}, {20, 0.4}, {20, 0.1}}));
}

TEST(AccuracyTime, SaysWhyItIsNotDrawn) {
  const auto figure = Registry<Figure>::make("accuracy_time", {{"metric", std::string("n")}});
  const auto counted = input_of({measured("a", {{"n", {4}}, {"scan_time", {10}}})});
  EXPECT_TRUE(figure->draw(counted).empty());
  EXPECT_NE(figure->why_nothing(counted).find("no value of the metric n is better"), std::string::npos);
  const auto untimed = input_of({measured("a", {{"n", {4}}})});
  EXPECT_NE(figure->why_nothing(untimed).find("value of the metric scan_time"), std::string::npos);
}

TEST(AccuracyTime, HasTheMetricAndTheTimeOfTheReportIfNoneIsNamed) {
  auto input = input_of({measured("a", {{"error", {0.002}}, {"scan_time", {1e-4}}}),
                         measured("b", {{"error", {0.004}}, {"scan_time", {2e-4}}})});
  input.quality = "error";
  input.looks["error"].label = "position error";
  const Scene scene = scene_of("accuracy_time", input);
  EXPECT_EQ(scene.panels[0].x.label, "CPU time of one scan");
  EXPECT_EQ(scene.panels[0].y.label, "position error");
  EXPECT_EQ(scene.panels[0].y.unit, "m");
  EXPECT_NE(scene.title.find("position error against time"), std::string::npos) << scene.title;
}

TEST(PrecisionRecall, CurvesFollowTheParameterOverLinesOfEqualF) {
  const auto input = input_of({measured("x_2", {{"precision", {0.9, 0.7}}, {"recall", {0.6, 0.6}}}, 0.2),
                               measured("x_1", {{"precision", {0.5}}, {"recall", {0.9}}}, 0.1),
                               measured("x_3", {{"precision", {0.95}}, {"recall", {0.2}}}, 0.3)});
  const Scene scene = scene_of("precision_recall", input);
  const auto lines = items<Polyline>(scene);
  const Polyline curve = lines.back();
  ASSERT_EQ(curve.points.size(), 3u);
  EXPECT_NEAR((curve.points[0] - Vec2(0.9, 0.5)).norm(), 0, 1e-12);
  EXPECT_NEAR((curve.points[1] - Vec2(0.6, 0.8)).norm(), 0, 1e-12);
  EXPECT_NEAR((curve.points[2] - Vec2(0.2, 0.95)).norm(), 0, 1e-12);
  ASSERT_GT(lines.size(), 5u);
  for (std::size_t k = 0; k + 1 < lines.size(); ++k) {
    const auto f = [](const Vec2& p) { return 1.0 / (0.5 / p.x() + 0.5 / p.y()); };  // harmonic mean
    for (const Vec2& p : lines[k].points) EXPECT_NEAR(f(p), f(lines[k].points.front()), 1e-9);
  }
}

TEST(Seeds, HasADotForEachSeedAndTheMeanWithItsInterval) {
  const Scene scene =
      scene_of("seeds", input_of({measured("a", {{"f1", {0.5, 0.9, 0.7}}}), measured("b", {{"f1", {0.8}}}),
                                  measured("failed", {{"f1", {kNaN}}})}));
  const auto points = items<Points>(scene);
  ASSERT_EQ(points.size(), 4u);  // dots and mean of each of two
  std::vector<double> values;
  for (const Vec2& p : points[0].points) values.push_back(p.x());
  std::ranges::sort(values);
  EXPECT_EQ(values, (std::vector{0.5, 0.7, 0.9}));
  EXPECT_NEAR(points[1].points.at(0).x(), 0.7, 1e-12);
  EXPECT_EQ(items<Lines>(scene).at(0).segments.at(0), (Segment{{0.5, 1}, {0.9, 1}}));
  EXPECT_EQ(scene.panels[0].y.ticks, (std::vector<std::pair<double, std::string>>{{1, "a"}, {0, "b"}}));
}

TEST(PerformanceProfile, IsThatOfDolanAndMore) {
  // Errors of two pipelines on three problems; b fails one of them.
  FigureInput input = input_of({});
  input.scenarios = {{"s1", {measured("a", {{"error", {0.01, 0.04}}}), measured("b", {{"error", {0.02, 0.01}}})}},
                     {"s2", {measured("a", {{"error", {0.03}}}), measured("b", {{"error", {kNaN}}})}}};
  const Scene scene = scene_of("performance_profile", input, {{"metric", std::string("error")}});
  const auto curves = items<Polyline>(scene);
  ASSERT_EQ(curves.size(), 2u);
  const auto share_at = [&](std::size_t curve, double tau) {
    double share = 0.0;
    for (const Vec2& p : curves[curve].points)
      if (p.x() <= tau + 1e-9) share = p.y();
    return share;
  };
  // Ratios of a: 1, 4, 1; of b: 2, 1, infinite.
  EXPECT_NEAR(share_at(0, 1.0), 2.0 / 3, 1e-12);
  EXPECT_NEAR(share_at(0, 3.9), 2.0 / 3, 1e-12);
  EXPECT_NEAR(share_at(0, 4.0), 1.0, 1e-12);
  EXPECT_NEAR(share_at(1, 1.0), 1.0 / 3, 1e-12);
  EXPECT_NEAR(share_at(1, 2.0), 2.0 / 3, 1e-12);
  EXPECT_NEAR(share_at(1, 4.1), 2.0 / 3, 1e-12);
}

TEST(PerformanceProfile, ComparesTheDifferenceToOneOfAShareAndIgnoresLessThanTheTolerance) {
  FigureInput input = input_of({});
  input.scenarios = {{"s", {measured("a", {{"f1", {1.0, 0.9}}}), measured("b", {{"f1", {0.996, 0.7}}})}}};
  const auto curves = items<Polyline>(scene_of("performance_profile", input));
  // Both are within 0.005 of 1 in the first problem; 0.1 and 0.3 are missing in the second.
  EXPECT_NEAR(curves.at(0).points.at(2).y(), 0.5, 1e-12);
  EXPECT_NEAR(curves.at(1).points.at(2).x(), 1.0, 1e-9);
  EXPECT_NEAR(curves.at(1).points.at(2).y(), 0.5, 1e-12);
  EXPECT_NEAR(curves.at(1).points.at(4).x(), 3.0, 1e-9);
}

// ---- of poses and beams

struct MadeUp {
  Recording recording;
  PipelineResult result;
  FigureInput input() const {
    FigureInput in{.title = "t", .recording = recording, .waypoints = {}, .results = {}};
    in.results.push_back({"p", &result});
    return in;
  }
};

MadeUp straight_path(int frames) {
  MadeUp made;
  made.recording.observed.sensor.geometry = ScanGeometry(radians(-90), radians(45), 5);
  made.recording.truth.emplace();
  for (int k = 0; k < frames; ++k) {
    made.recording.truth->world_from_sensor.emplace_back(0.5 * k, 0.0, 0.0);
    made.recording.observed.frames.push_back({0.0, std::vector<double>(5, kInf), Pose2(0.5 * k, 0.1 * k, 0.0)});
  }
  return made;
}

TEST(TrajectoryError, IsTheDistanceFromTheTruthAlongThePath) {
  MadeUp made = straight_path(5);
  for (const Pose2& pose : made.recording.truth->world_from_sensor)
    made.result.world_from_sensor.push_back(Pose2(0.3, -0.4, 0.0) * pose * Pose2(0, 0, radians(2)));
  const Scene none = scene_of("trajectory_error", made.input(), {{"align", std::string("none")}});
  const Polyline shift = items<Polyline>(none, 0).at(1), turn = items<Polyline>(none, 1).at(1);  // after the odometry
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(shift.points.at(k).x(), 0.5 * static_cast<double>(k), 1e-12);
    EXPECT_NEAR(shift.points.at(k).y(), 0.5, 1e-12);
    EXPECT_NEAR(turn.points.at(k).y(), 2.0, 1e-9);
  }
  const Scene first = scene_of("trajectory_error", made.input(), {{"align", std::string("first")}});
  EXPECT_NEAR(items<Polyline>(first, 0).at(1).points.at(0).y(), 0.0, 1e-12);
  EXPECT_NEAR(items<Polyline>(first, 0).at(1).points.at(4).y(), 2 * 2.0 * std::sin(radians(1)), 1e-9) << "2 m, turned";
}

TEST(BeamResiduals, AreAlongTheBeamAndExaggerated) {
  MadeUp made = straight_path(1);
  made.recording.observed.frames[0].ranges = {kInf, kInf, 2.01, 2.0 * std::sqrt(2.0) - 0.02, kInf};
  LineFeature wall;
  wall.segment = {{2, 0}, {2, 2}};
  wall.line = line_through(wall.segment.a, wall.segment.b);
  made.result.lines.push_back({.lines = {wall}, .labels = {-1, -1, 0, 0, -1}});
  const Scene scene = scene_of("beam_residuals", made.input(), {{"exaggeration", 10.0}});
  const auto lines = items<Lines>(scene);
  ASSERT_EQ(lines.size(), 3u);
  ASSERT_EQ(lines[0].segments.size(), 1u);
  EXPECT_NEAR((lines[0].segments[0].a - Vec2(2, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((lines[0].segments[0].b - Vec2(2.1, 0)).norm(), 0, 1e-9) << "1 cm behind the wall";
  const double d = 0.2 / std::sqrt(2.0);
  EXPECT_NEAR((lines[1].segments.at(0).a - Vec2(2, 2)).norm(), 0, 1e-12);
  EXPECT_NEAR((lines[1].segments.at(0).b - Vec2(2 - d, 2 - d)).norm(), 0, 1e-9) << "2 cm before it, at 45 degrees";
}

TEST(ErrorEllipses, HaveTheAxesOfBothCovariances) {
  MadeUp made = straight_path(21);
  const auto& poses = made.recording.truth->world_from_sensor;
  for (int k = 1; k <= 20; ++k) {
    // Errors of 3 cm along one axis and 1 cm along the other, turned by 30 degrees: second moments 9 and 1 cm^2.
    const Vec2 e = Pose2(0, 0, radians(30)).rotate({k % 2 == 0 ? 0.03 : -0.03, k % 4 < 2 ? 0.01 : -0.01});
    const auto at = static_cast<std::size_t>(k);
    FrameMatch match{.frame = k, .reference = k - 1, .match = {}};
    match.match.reference_from_current = Pose2(e, 0.0) * (poses[at - 1].inverse() * poses[at]);
    match.match.covariance = Eigen::Matrix3d(Eigen::Vector3d(4e-4, 1e-4, 1e-6).asDiagonal());
    if (k == 20) match.match.status = Status::degenerate;
    if (k == 20) match.match.covariance *= 1e6;
    made.result.matches.push_back(match);
  }
  made.result.matches.push_back(made.result.matches[19]);
  made.result.matches.back().match.status = Status::converged;
  made.result.matches.back().match.covariance *= 1e-6;
  const Scene scene = scene_of("error_ellipses", made.input(), {{"of", std::string("matches")}});
  const auto ellipses = items<Ellipse>(scene);
  ASSERT_EQ(ellipses.size(), 2u);
  const double root = std::sqrt(-2.0 * std::log(0.05));  // 95 % of a normal distribution in the plane
  EXPECT_NEAR(ellipses[0].semi_axes.x(), 30 * root, 1e-6);
  EXPECT_NEAR(ellipses[0].semi_axes.y(), 10 * root, 1e-6);
  EXPECT_NEAR(std::remainder(ellipses[0].angle_rad - radians(30), kPi), 0.0, 1e-9);
  EXPECT_NEAR(ellipses[1].semi_axes.x(), 20 * root, 1e-6);
  EXPECT_NEAR(ellipses[1].semi_axes.y(), 10 * root, 1e-6);
}

TEST(ErrorEllipses, OfVeryDifferentSizeHaveTheirOwnScales) {
  for (const double larger : {1.5, 50.0}) {
    MadeUp made = straight_path(10), other = made;
    const auto& poses = made.recording.truth->world_from_sensor;
    for (auto [result, size] : {std::pair(&made.result, 1.0), std::pair(&other.result, larger)})
      for (int k = 1; k < 10; ++k) {
        const auto at = static_cast<std::size_t>(k);
        const Vec2 e = 0.001 * size * Vec2(k % 2 == 0 ? 1 : -1, k % 4 < 2 ? 1 : -1);
        FrameMatch match{.frame = k, .reference = k - 1, .match = {}};
        match.match.reference_from_current = Pose2(e, 0.0) * (poses[at - 1].inverse() * poses[at]);
        match.match.covariance = 1e-6 * size * size * Eigen::Matrix3d::Identity();
        result->matches.push_back(match);
      }
    FigureInput input = made.input();
    input.results.push_back({"q", &other.result});
    const Scene scene = scene_of("error_ellipses", input, {{"of", std::string("matches")}});
    ASSERT_EQ(scene.panels.size(), 2u);
    const Layout placed = layout(scene);
    for (std::size_t i = 0; i < 2; ++i) {  // an ellipse is at least an eighth of its panel wide
      const double wide = 2.0 * items<Ellipse>(scene, i).at(0).semi_axes.x();
      EXPECT_GT(wide / (placed.panels[i].x_max - placed.panels[i].x_min), 0.125) << larger;
    }
    EXPECT_EQ(scene.share_axes, larger < 2.0);
  }
}

TEST(ErrorEllipses, OfLinesAreTheirErrorsAtTheMidpoint) {
  MadeUp made = straight_path(10);
  made.recording.truth->walls = {{"wall", {{50, 2}, {-50, 2}}}};
  made.recording.truth->wall_ids = std::vector<std::int32_t>(50, 0);
  for (int f = 0; f < 10; ++f) {
    const double offset = f % 2 == 0 ? 0.02 : -0.02, slope = std::tan(radians(f % 4 < 2 ? 1.0 : -1.0));
    LineFeature line;
    line.segment = {{1, 2 + offset + slope}, {-1, 2 + offset - slope}};
    line.line = line_through(line.segment.a, line.segment.b);
    line.covariance = Eigen::Matrix2d(Eigen::Vector2d(1e-4, radians(2) * radians(2)).asDiagonal());
    made.result.lines.push_back({.lines = {line}, .labels = std::vector<int>(5, 0)});
  }
  const auto ellipses = items<Ellipse>(scene_of("error_ellipses", made.input()));
  ASSERT_EQ(ellipses.size(), 2u);
  const double root = std::sqrt(-2.0 * std::log(0.05));
  EXPECT_NEAR(ellipses[0].semi_axes.x(), 20 * root, 0.02) << "mm";
  EXPECT_NEAR(ellipses[0].semi_axes.y(), 1 * root, 1e-3) << "deg";
  EXPECT_NEAR(ellipses[1].semi_axes.x(), 10 * root, 1e-6);
  EXPECT_NEAR(ellipses[1].semi_axes.y(), 2 * root, 1e-6);
}

}  // namespace
}  // namespace scanbench::render
