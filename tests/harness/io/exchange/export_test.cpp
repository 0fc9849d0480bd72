// Exports read back: the same ranges and angles, for recordings of every shape.
#include "harness/io/exchange/export.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.hpp"
#include "harness/io/exchange/log.hpp"
#include "harness/io/exchange/polygon_files.hpp"
#include "sim/sensors.hpp"
#include "tests/support/inputs.hpp"

namespace scanbench::io {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

// Ranges as a sensor gives them: readings within the limits, and the three kinds of none.
Recording random_recording(std::uint64_t seed) {
  CounterRng rng(seed, RngStream::resampling);
  static constexpr int kBeams[] = {1, 2, 5, 180, 181, 360, 361, 451};
  const int beams = kBeams[static_cast<std::size_t>(rng.uniform() * 8)];
  const bool flaser = rng.uniform() < 0.5 && beams >= 180 && beams <= 361;
  Recording r;
  SensorModel& sensor = r.observed.sensor;
  sensor = sim::make_sensor("custom", {});
  const double step = flaser ? 180.0 / (beams % 2 ? beams - 1 : beams) : 0.1 + 0.5 * rng.uniform();
  sensor.geometry = ScanGeometry(radians(flaser ? -90.0 : -180.0 * rng.uniform()),
                                 radians(rng.uniform() < 0.2 && !flaser ? -step : step), beams);
  sensor.range_min_m = rng.uniform() < 0.5 ? 0.0 : 0.1;
  sensor.range_max_m = 30.0;
  const auto frames = static_cast<std::size_t>(1 + 5 * rng.uniform());
  for (std::size_t i = 0; i < frames; ++i) {
    Frame frame;
    frame.stamp_s = 0.1 * static_cast<double>(i) + rng.uniform() * 0.01;
    frame.odom_from_sensor = Pose2(10 * rng.normal(), 10 * rng.normal(), 3 * rng.normal());
    for (int b = 0; b < beams; ++b) {
      const double u = rng.uniform();
      frame.ranges.push_back(u < 0.1                             ? kInf
                             : u < 0.2                           ? std::numeric_limits<double>::quiet_NaN()
                             : u < 0.3 && sensor.range_min_m > 0 ? -kInf
                                                                 : 0.1 + 29.9 * rng.uniform());
    }
    r.observed.frames.push_back(std::move(frame));
  }
  return r;
}

class ExportAndBack : public testing::TestWithParam<const char*> {};

TEST_P(ExportAndBack, GivesTheSameRangesAnglesStampsAndPoses) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const Recording r = random_recording(seed);
    const std::string text = export_text(r, GetParam());
    const Recording back = parse_log(text, "x.log", GetParam(), import_params(r, GetParam()), r.observed.sensor);
    ASSERT_EQ(back.observed.frames.size(), r.observed.frames.size());
    for (int b = 0; b < r.observed.sensor.geometry.beams(); ++b)
      EXPECT_NEAR(back.observed.sensor.geometry.angle(b), r.observed.sensor.geometry.angle(b), 1e-12);
    for (std::size_t i = 0; i < r.observed.frames.size(); ++i) {
      const Frame& a = r.observed.frames[i];
      const Frame& b = back.observed.frames[i];
      EXPECT_EQ(b.stamp_s, a.stamp_s);
      EXPECT_EQ(b.odom_from_sensor.translation(), a.odom_from_sensor.translation());
      EXPECT_NEAR(wrap_angle(b.odom_from_sensor.yaw() - a.odom_from_sensor.yaw()), 0, 1e-15);
      ASSERT_EQ(b.ranges.size(), a.ranges.size());
      for (std::size_t k = 0; k < a.ranges.size(); ++k)
        EXPECT_TRUE(b.ranges[k] == a.ranges[k] || (std::isnan(a.ranges[k]) && std::isnan(b.ranges[k])))
            << a.ranges[k] << " became " << b.ranges[k];
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, ExportAndBack, testing::Values("carmen", "csv"));

TEST(Export, CarmenUsesFlaserOnlyWhereReadersAgreeOnItsAngles) {
  Recording r = random_recording(1);
  r.observed.sensor.geometry = ScanGeometry(radians(-90), radians(1), 181);
  for (auto& frame : r.observed.frames) frame.ranges.assign(181, 2.0);
  EXPECT_NE(export_text(r, "carmen").find("\nFLASER 181 2 "), std::string::npos);
  r.observed.sensor.geometry = ScanGeometry(radians(-89.5), radians(1), 181);
  EXPECT_NE(export_text(r, "carmen").find("\nROBOTLASER1 "), std::string::npos);
}

TEST(Export, CarmensFirstTripleIsTheTruth) {
  Recording r = random_recording(2);
  r.truth.emplace();
  for (std::size_t i = 0; i < r.observed.frames.size(); ++i)
    r.truth->world_from_sensor.emplace_back(7.0, static_cast<double>(i), 0.5);
  ParamSet params = import_params(r, "carmen");
  params["poses"] = std::string("reference");
  const Recording back = parse_log(export_text(r, "carmen"), "x.log", "carmen", params, r.observed.sensor);
  EXPECT_EQ(back.observed.frames[0].odom_from_sensor.x(), 7.0);
}

TEST(Export, TumIsTimePositionAndQuaternion) {
  EXPECT_EQ(tum_text({{1.5, Pose2(2, 3, 0)}}), "# timestamp tx ty tz qx qy qz qw\n1.5 2 3 0 0 0 0 1\n");
  const std::string half_turn = tum_text({{0, Pose2(0, 0, kPi / 2)}});
  double qz = 0;
  double qw = 0;
  ASSERT_EQ(std::sscanf(half_turn.c_str() + half_turn.find('\n'), " %*f %*f %*f %*f %*f %*f %lf %lf", &qz, &qw), 2);
  EXPECT_NEAR(qz, std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(qw, std::sqrt(0.5), 1e-15);
}

TEST(Export, LinesAreNoScans) {
  Recording lines;
  lines.observed.frames.resize(1);
  lines.observed.frames[0].lines = {{{0, 0}, {1, 0}}};
  EXPECT_THAT(support::config_refusal([&] { export_text(lines, "carmen"); }), testing::HasSubstr("holds no scans"));
  EXPECT_NO_THROW(export_text(lines, "tum"));
}

TEST(Export, UnknownFormatsAreRefused) {
  EXPECT_THAT(support::config_refusal([] { export_text({}, "carmn"); }), testing::HasSubstr("did you mean 'carmen'?"));
}

TEST(PolygonsCsv, HasTheRecordsOfEveryFrame) {
  LineFeature wall;
  wall.segment = {{2, -1}, {2, 3}};
  wall.line = {2, 0};
  wall.points = 41;
  EXPECT_EQ(
      polygons_csv({{}, {{wall}, {}}}),
      "frame,segment,x1_m,y1_m,x2_m,y2_m,direction_x,direction_y,normal_x,normal_y,length_m,distance_m,points,flags\n"
      "1,0,2,-1,2,3,0,1,1,0,4,2,41,1\n");
}

}  // namespace
}  // namespace scanbench::io
