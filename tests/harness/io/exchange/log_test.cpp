// Log readers: the meaning of lines, refusals, and well-known logs.
#include "harness/io/exchange/log.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>

#include "harness/runs/execute/make_recording.hpp"
#include "harness/study/scenario/effective.hpp"
#include "harness/study/scenario/scenario.hpp"
#include "harness/study/scenario/scenario_file.hpp"
#include "sim/sensors.hpp"
#include "tests/support/inputs.hpp"

namespace scanbench::io {
namespace {

using testing::HasSubstr;
constexpr double kNoReturn = std::numeric_limits<double>::infinity();

SensorModel sensor() {
  return sim::make_sensor("custom", {});
}

Recording carmen(const std::string& text, ParamSet params = {}) {
  return parse_log(text, "l.log", "carmen", params, sensor());
}
Recording csv(const std::string& text, ParamSet params = {}) {
  params.emplace("step_deg", 1.0);
  return parse_log(text, "l.csv", "csv", params, sensor());
}

std::string flaser(int n, double range, const std::string& tail) {
  std::string line = "FLASER " + std::to_string(n);
  for (int i = 0; i < n; ++i) line += " " + std::to_string(range);
  return line + " " + tail + "\n";
}

const std::string kTail = "1 2 0.5 3 4 0.25 17.5 host 18.5";

TEST(CarmenLog, TheFirstTripleIsTheLasersPoseAndTheSecondTheOdometrys) {
  const std::string text = "# a log\nPARAM x 1\nODOM 1 2 3 4 5 6 7 h 7\n" + flaser(180, 2.5, kTail);
  const Recording reference = carmen(text);
  ASSERT_EQ(reference.observed.frames.size(), 1U);
  EXPECT_EQ(reference.observed.frames[0].odom_from_sensor, Pose2(1, 2, 0.5));
  EXPECT_EQ(reference.observed.frames[0].stamp_s, 17.5);
  EXPECT_EQ(reference.observed.frames[0].ranges[179], 2.5);
  EXPECT_EQ(carmen(text, {{"poses", std::string("odometry")}}).observed.frames[0].odom_from_sensor, Pose2(3, 4, 0.25));
}

TEST(CarmenLog, WithoutPosesTheScansHaveNoOdometry) {
  const Recording log = carmen(flaser(180, 2.5, kTail), {{"poses", std::string("none")}});
  EXPECT_EQ(log.observed.frames[0].odom_from_sensor, Pose2());
}

TEST(CarmenLog, PosesToCompareWithAreKeptApartFromThoseThatAlgorithmsSee) {
  const std::string text = flaser(180, 2.5, kTail) + flaser(180, 2.5, kTail);
  EXPECT_FALSE(carmen(text).reference);
  const Recording log = carmen(text, {{"poses", std::string("odometry")}, {"compare_poses", std::string("reference")}});
  ASSERT_TRUE(log.reference);
  EXPECT_EQ(log.reference->world_from_sensor, std::vector<Pose2>(2, Pose2(1, 2, 0.5)));
  EXPECT_EQ(log.observed.frames[0].odom_from_sensor, Pose2(3, 4, 0.25));
  EXPECT_THAT(support::config_refusal([&] {
                carmen(text, {{"compare_poses", std::string("vertex")}});
              }),
              HasSubstr("l.log:1:1: no VERTEX2 line before this scan"));
}

TEST(CarmenLog, BeamAnglesFollowTheStatedRule) {
  const auto angles = [](int n) {
    const Recording r = carmen(flaser(n, 1, kTail));
    const ScanGeometry& g = r.observed.sensor.geometry;
    return std::pair(degrees(g.angle(0)), degrees(g.angle(n - 1)));
  };
  for (const int n : {180, 360}) {
    EXPECT_NEAR(angles(n).first, -90, 1e-9);
    EXPECT_NEAR(angles(n).second, 90 - 180.0 / n, 1e-9);
  }
  for (const int n : {181, 361}) {
    EXPECT_NEAR(angles(n).first, -90, 1e-9);
    EXPECT_NEAR(angles(n).second, 90, 1e-9);
  }
  EXPECT_THAT(support::config_refusal([&] { angles(400); }),
              HasSubstr("l.log:1:1: a scan of 400 ranges without beam angles"));
  const Recording given = carmen(flaser(400, 1, kTail), {{"first_angle_deg", -50.0}, {"step_deg", 0.25}});
  EXPECT_NEAR(degrees(given.observed.sensor.geometry.angle(4)), -49, 1e-9);
}

TEST(CarmenLog, ReadingsBecomeWhatRep117Says) {
  std::string text = "FLASER 180 0 0.01 49.5 50 81.83 -1";
  for (int i = 6; i < 180; ++i) text += " 3";
  const Recording r = carmen(text + " 0 0 0 0 0 0 1 h 1\n", {{"no_return_m", 50.0}, {"range_min_m", 0.02}});
  const auto& ranges = r.observed.frames[0].ranges;
  EXPECT_TRUE(std::isnan(ranges[0]));
  EXPECT_EQ(ranges[1], -kNoReturn);
  EXPECT_EQ(ranges[2], 49.5);
  EXPECT_EQ(ranges[3], kNoReturn);
  EXPECT_EQ(ranges[4], kNoReturn);
  EXPECT_TRUE(std::isnan(ranges[5]));
  EXPECT_EQ(r.observed.sensor.range_max_m, 50.0);
}

TEST(CarmenLog, RobotlaserStatesItsAngles) {
  const Recording r =
      carmen("ROBOTLASER1 0 -0.5 1.0 0.25 50 0.1 0 5 1 2 3 4 5 2 7 7 1 2 0.5 3 4 0.25 0 0 0 0 0 9.5 h 9.5\n");
  EXPECT_EQ(r.observed.frames[0].ranges, (std::vector<double>{1, 2, 3, 4, 5}));
  EXPECT_NEAR(r.observed.sensor.geometry.angle(4), 0.5, 1e-12);
  EXPECT_EQ(r.observed.frames[0].odom_from_sensor, Pose2(1, 2, 0.5));
  EXPECT_EQ(r.observed.frames[0].stamp_s, 9.5);
}

TEST(CarmenLog, GraphLogsGiveTheVertexBeforeAScan) {
  const std::string scan = "ROBOTLASER1 0 -0.5 1.0 0.25 50 0.1 0 2 1 2 0 1 2 0.5 3 4 0.25 0 0 0 0 0 9.5 h 9.5\n";
  const ParamSet vertex = {{"poses", std::string("vertex")}};
  const Recording r = carmen(
      "VERTEX2 0 7 8 -1\n" + scan + "VERTEX2 1 9 8 -1\n" + scan + "#LOOP EDGES\nEDGE2 0 1 1 0 0 1 0 0 1 0 1\n", vertex);
  EXPECT_EQ(r.observed.frames[1].odom_from_sensor, Pose2(9, 8, -1));
  EXPECT_THAT(support::config_refusal([&] { carmen("VERTEX2 0 7 8 -1\n" + scan + scan, vertex); }),
              HasSubstr("l.log:3:1: no VERTEX2 line before this scan"));
}

TEST(CarmenLog, TheSensorsPlaceOnTheRobotIsApplied) {
  const Recording r = carmen(flaser(180, 1, "1 2 0 1 2 0 1 h 1"), {{"sensor_x_m", 0.5}, {"sensor_y_m", -1.0}});
  EXPECT_EQ(r.observed.frames[0].odom_from_sensor, Pose2(1.5, 1, 0));
}

TEST(CarmenLog, EveryAndMaxFramesThinTheLog) {
  std::string text;
  for (int i = 0; i < 10; ++i) text += flaser(180, i + 1, kTail);
  const Recording r = carmen(text, {{"every", std::int64_t{3}}, {"max_frames", std::int64_t{2}}});
  ASSERT_EQ(r.observed.frames.size(), 2U);
  EXPECT_EQ(r.observed.frames[1].ranges[0], 4.0);
}

TEST(CarmenLog, RefusalsNamePlaceAndFinding) {
  const auto refusal = [](const std::string& text) { return support::config_refusal([&] { carmen(text); }); };
  const std::string good = flaser(180, 1, kTail);
  EXPECT_THAT(refusal(""), HasSubstr("l.log:1:1: no FLASER or ROBOTLASER1 line"));
  EXPECT_THAT(refusal("ODOM 1 2 3\n"), HasSubstr("no FLASER or ROBOTLASER1 line in 1 lines"));
  EXPECT_THAT(refusal("t, x, y\n1, 2, 3\n"),
              HasSubstr("l.log:1:1: a line that begins with 't,'; allowed: CARMEN messages"));
  EXPECT_THAT(refusal("\x89PNG\r\n"), HasSubstr("l.log:1:1: a line that begins with"));
  EXPECT_THAT(refusal(good + flaser(181, 1, kTail)),
              HasSubstr("l.log:2:1: 181 ranges, but the scan in line 1 has 180"));
  EXPECT_THAT(refusal(good + good.substr(0, good.size() / 2)),
              HasSubstr("l.log:2:8: the number of ranges is 180, but only"));
  EXPECT_THAT(refusal(good + good.substr(0, good.size() / 2)), HasSubstr("is it cut short?"));
  EXPECT_THAT(refusal(good + good.substr(0, good.size() - 16)), HasSubstr("is it cut short?"));
  EXPECT_THAT(refusal(flaser(180, 1, kTail + " 5")),
              HasSubstr("FLASER states 180 ranges and has 191 words after its name; allowed: 190"));
  EXPECT_THAT(refusal("FLASER 2 1 x 0 0 0 0 0 0 1 h 1\n"), HasSubstr("a scan of 2 ranges"));
  std::string word = good;
  word.replace(word.find("1.0"), 3, "abc");
  EXPECT_THAT(refusal(word), HasSubstr("l.log:1:12: a range is 'abc00000'; allowed: a number"));
  EXPECT_THAT(refusal("FLASER many 1 2\n"),
              HasSubstr("l.log:1:8: the number of ranges is 'many'; allowed: a whole number"));
  EXPECT_THAT(refusal("FLASER 99999999999 1 2\n"), HasSubstr("but only 2 words follow"));
  EXPECT_THAT(refusal("FLASER\n"), HasSubstr("the line ends before the number of ranges"));
  EXPECT_THAT(refusal(flaser(180, 1, "0 0 1e9 0 0 0 1 h 1")), HasSubstr("a heading of 1000000000 rad"));
}

TEST(CsvLog, ColumnsSayWhatTheFieldsAre) {
  const Recording r = csv("t, x, y\n# scan\n1500, 9, 200, 30, 90, 1000, 2000 , 0\n",
                          {{"columns", std::string("t_ms skip x_cm y_mm yaw_deg ranges skip")},
                           {"skip_lines", std::int64_t{1}},
                           {"unit_m", 0.001}});
  ASSERT_EQ(r.observed.frames.size(), 1U);
  const Frame& frame = r.observed.frames[0];
  EXPECT_DOUBLE_EQ(frame.stamp_s, 1.5);
  EXPECT_DOUBLE_EQ(frame.odom_from_sensor.x(), 2.0);
  EXPECT_DOUBLE_EQ(frame.odom_from_sensor.y(), 0.03);
  EXPECT_DOUBLE_EQ(frame.odom_from_sensor.yaw(), kPi / 2);
  EXPECT_EQ(frame.ranges, (std::vector<double>{1.0, 2.0}));
}

TEST(CsvLog, InfinitiesAndNanAreAllowedAmongTheRanges) {
  const Recording r = csv("inf -inf nan 2\n", {{"beams", std::int64_t{4}}});
  const auto& ranges = r.observed.frames[0].ranges;
  EXPECT_EQ(ranges[0], kNoReturn);
  EXPECT_EQ(ranges[1], -kNoReturn);
  EXPECT_TRUE(std::isnan(ranges[2]));
}

TEST(CsvLog, RefusalsNamePlaceAndFinding) {
  const auto refusal = [](const std::string& text, ParamSet params = {}) {
    return support::config_refusal([&] { csv(text, params); });
  };
  EXPECT_THAT(refusal("1 2 3\n1 2\n"), HasSubstr("l.csv:2:1: 2 ranges, but the scan in line 1 has 3"));
  EXPECT_THAT(refusal("1 2 3\n", {{"beams", std::int64_t{4}}}), HasSubstr("a row with 3 ranges; allowed: beams = 4"));
  EXPECT_THAT(refusal("1,,3\n"), HasSubstr("l.csv:1:3: a range is ''"));
  EXPECT_THAT(refusal("1\n", {{"columns", std::string("t_s x_m ranges")}}),
              HasSubstr("a row of 1 fields; allowed: at least 3"));
  EXPECT_THAT(refusal("1\n", {{"columns", std::string("t_s x")}}),
              HasSubstr("columns has 'x'; did you mean 'x_m'? allowed: t_s"));
  EXPECT_THAT(refusal("1\n", {{"columns", std::string("t_s t_ms ranges")}}), HasSubstr("a second time"));
  EXPECT_THAT(refusal("1\n", {{"columns", std::string("t_s")}}), HasSubstr("columns has no 'ranges'"));
  EXPECT_THAT(refusal("# nothing\n"), HasSubstr("no row with a scan"));
  EXPECT_THAT(support::config_refusal([] { parse_log("1 2\n", "l.csv", "csv", {}, sensor()); }),
              HasSubstr("step_deg is 0"));
}

TEST(CsvLog, AVectorMapIsNoLogOfFourBeams) {
  const std::string map = "0, 0, 4, 0\n4, 0, 4, 3\n";
  EXPECT_THAT(support::config_refusal([&] { csv(map); }), HasSubstr("l.csv:1:1: a row of four numbers: a vector map"));
  EXPECT_EQ(csv(map, {{"beams", std::int64_t{4}}}).observed.frames.size(), 2U);
}

TEST(LogParams, AreCheckedWithoutTheLog) {
  const auto refusal = [](const std::string& format, const ParamSet& params) {
    return support::config_refusal([&] { check_log_params(format, params); });
  };
  EXPECT_EQ(refusal("csv", {{"step_deg", 1.0}}), "");
  EXPECT_EQ(refusal("csv", {{"beams", std::int64_t{1}}}), "") << "a single beam needs no step";
  EXPECT_THAT(refusal("csv", {}), HasSubstr("step_deg is 0"));
  EXPECT_THAT(refusal("csv", {{"step_deg", 1.0}, {"columns", std::string("t_s rangs")}}),
              HasSubstr("columns has 'rangs'"));
  EXPECT_EQ(refusal("carmen", {}), "");
}

TEST(LogFormats, EveryFormatSaysHowItsAnglesFollow) {
  for (const auto& format : log_formats()) {
    const LogFormatText text = log_format_text(format);
    EXPECT_FALSE(text.summary.empty());
    EXPECT_THAT(text.notes, testing::Contains(HasSubstr("beam angles"))) << format;
  }
}

TEST(Log, MoreThanTheLimitIsRefusedWithoutKeepingIt) {
  const support::TemporaryFolder folder;
  const auto refusal = [&](const std::string& name, const std::string& bytes) {
    return support::config_refusal([&] { read_log(folder.write(name, bytes), "carmen", {}, sensor(), 1 << 28); });
  };
  EXPECT_THAT(refusal("line.gz", support::gzip("FLASER " + std::string(17 << 20, '1'))),
              HasSubstr("line.gz: a line longer than 16 MiB"));
  EXPECT_THAT(refusal("zeros.gz", support::gzip(std::string(5 << 20, '\0'))), HasSubstr("zeros.gz:1:1: a byte 0"));
  std::string blanks;
  for (int i = 0; i < 4000; ++i) blanks += std::string(9999, ' ') + "\n";
  EXPECT_THAT(refusal("blanks.gz", support::gzip(blanks)), HasSubstr("blanks.gz: needs about"));
}

TEST(CheckScenario, ReadsTheLog) {
  const support::TemporaryFolder folder;
  const std::string head = "schema: 1\nrecording: {log: l.log, format: carmen, no_return_m: 80}\n";
  folder.write("l.log", "ODOM 1 2 3\n");
  const auto scenario = study::parse_scenario(head, folder.path() / "s.yaml");
  EXPECT_THAT(support::config_refusal([&] { runs::check_scenario(scenario); }), HasSubstr("l.log:1:1: no FLASER"));
  folder.write("l.log", flaser(180, 1, kTail));
  EXPECT_EQ(support::config_refusal([&] { runs::check_scenario(scenario); }), "");
}

TEST(Scenario, ALogThatIsNoFileIsRefusedWhereItIsNamed) {
  EXPECT_THAT(support::config_refusal([] {
                study::parse_scenario("schema: 1\nrecording: {log: /dev/zero, format: carmen, no_return_m: 80}\n",
                                      "s.yaml");
              }),
              HasSubstr("s.yaml:2:18: /dev/zero: not a regular file"));
}

TEST(DpslamLog, TakesOdometryAndLaserInTurns) {
  std::string laser = "Laser 181";
  for (int i = 0; i < 181; ++i) laser += " 2";
  const auto read = [](const std::string& text) {
    return parse_log(text, "l.log", "dpslam", {{"no_return_m", 8.0}}, sensor());
  };
  const Recording r = read("Odometry 1 2 0.5\n" + laser + "\nOdometry 2 2 0.5 \n" + laser + "\n");
  ASSERT_EQ(r.observed.frames.size(), 2U);
  EXPECT_EQ(r.observed.frames[1].odom_from_sensor, Pose2(2, 2, 0.5));
  EXPECT_DOUBLE_EQ(r.observed.frames[1].stamp_s, sensor().scan_period_s);
  EXPECT_NEAR(degrees(r.observed.sensor.geometry.angle(180)), 90, 1e-9);
  EXPECT_THAT(support::config_refusal([&] { read(laser + "\n"); }),
              HasSubstr("a Laser line without an Odometry line before it"));
  EXPECT_THAT(support::config_refusal([&] { read("Odometry 1 2 0.5\n" + laser + " 3\n"); }),
              HasSubstr("Laser states '181' ranges and has 182"));
  EXPECT_THAT(support::config_refusal([&] { read("Odometry 1 2\n"); }), HasSubstr("allowed: Odometry x y yaw"));
  EXPECT_THAT(support::config_refusal([&] { read("FLASER 1\n"); }), HasSubstr("a line that begins with 'FLASER'"));
}

TEST(Log, UnknownFormatsAndDamagedFilesAreRefused) {
  EXPECT_THAT(support::config_refusal([] { log_param_specs("rosbag"); }), HasSubstr("allowed: carmen, csv, dpslam"));
  const support::TemporaryFolder folder;
  const std::string packed = support::gzip(flaser(180, 1, kTail));
  const auto read = [&](const std::string& name, const std::string& bytes, double memory) {
    return support::config_refusal([&] { read_log(folder.write(name, bytes), "carmen", {}, sensor(), memory); });
  };
  EXPECT_EQ(read("good.gz", packed, 1e9), "");
  EXPECT_THAT(read("short.gz", packed.substr(0, packed.size() - 10), 1e9), HasSubstr("short.gz: "));
  std::string short_numbers = "FLASER 180";
  for (int i = 0; i < 180; ++i) short_numbers += " 1";
  EXPECT_THAT(read("big.log", short_numbers + " " + kTail + "\n", 1000), HasSubstr("numbers x 8 B"));
}

TEST(Log, APackedLogIsReadWithoutItsText) {
  const support::TemporaryFolder folder;
  const std::string comment = "# " + std::string(1000, 'c') + "\n";
  std::string text = flaser(180, 1, kTail);
  for (int i = 0; i < 64000; ++i) text += comment;
  const auto log = folder.write("comments.gz", support::gzip(text));
  text = std::string();
  const auto peak_kib = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
  };
  const pid_t child = fork();  // whose memory no earlier test has used
  if (child == 0) {
    const auto before = peak_kib();
    const bool read = read_log(log, "carmen", {}, sensor(), 1e9).observed.frames.size() == 1;
    _exit(read && peak_kib() - before < 16000 ? 0 : 1);  // of 64 MB
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

std::string row(int n, const std::string& number) {
  std::string text = number;
  for (int i = 1; i < n; ++i) text += " " + number;
  return text;
}

TEST(Log, ACutInsideTheLastNumberIsRefusedWhereItsDecimalsTell) {
  const auto refusal = [](const std::string& text) { return support::config_refusal([&] { csv(text); }); };
  const std::string good = row(40, "1.234");
  EXPECT_EQ(refusal(good + "\n" + good), "");  // whole, but for the line break
  for (const std::string last : {"1.23", "1.", "1"}) {
    EXPECT_THAT(refusal(good + "\n" + row(39, "1.234") + " " + last),
                HasSubstr("l.csv:2:235: '" + last + "' has fewer than the 3 decimals"));
    EXPECT_THAT(refusal(good + "\n" + row(39, "1.234") + " " + last), HasSubstr("is it cut short?"));
    EXPECT_EQ(refusal(good + "\n" + row(39, "1.234") + " " + last + "\n"), "") << "the line is whole";
  }
  EXPECT_EQ(refusal(row(20, "1.234 1.2") + " 1"), "") << "numbers vary in width";
  EXPECT_EQ(refusal(row(40, "1234") + " 12"), "") << "whole numbers do not show it";
  EXPECT_THAT(support::config_refusal([] {
                parse_log("Odometry 1 2 0.5\nLaser 181 " + row(180, "2.50") + " 2.5", "l.log", "dpslam", {}, sensor());
              }),
              HasSubstr("l.log:2:911: '2.5' has fewer than the 2 decimals"));
}

// Counts are those of the data sets' own descriptions.
struct KnownLog {
  const char* scenario;
  std::size_t frames;
  int beams;
};

void PrintTo(const KnownLog& log, std::ostream* out) {
  *out << log.scenario;
}

class KnownLogs : public testing::TestWithParam<KnownLog> {};

TEST_P(KnownLogs, ReadsWithItsExampleScenario) {
  const auto& [name, frames, beams] = GetParam();
  if (!std::filesystem::exists(support::data_dir() / name)) GTEST_SKIP() << name << " is not there";
  setenv("SCANBENCH_DATA", support::data_dir().c_str(), 0);
  const study::Scenario scenario =
      study::load_scenario(support::source_dir() / "scenarios/logs" / (std::string(name) + ".yaml"));
  const std::string effective = study::effective_yaml(scenario);
  EXPECT_EQ(study::effective_yaml(study::parse_scenario(effective, "/elsewhere/effective.yaml")), effective);
  const Recording r = runs::make_recording(scenario, 1, 1);
  EXPECT_EQ(r.observed.frames.size(), frames);
  EXPECT_EQ(r.observed.sensor.geometry.beams(), beams);
  EXPECT_FALSE(r.truth.has_value());
  std::size_t valid = 0;
  for (std::size_t i = 0; i < frames; ++i)
    for (int b = 0; b < beams; ++b) valid += r.observed.scan(i).valid(b) ? 1U : 0U;
  EXPECT_GT(valid, frames * static_cast<std::size_t>(beams) / 4);
}

INSTANTIATE_TEST_SUITE_P(Data, KnownLogs,
                         testing::Values(KnownLog{"radish-intel", 910, 180}, KnownLog{"radish-seattle", 241, 361},
                                         KnownLog{"radish-aces", 440, 180}, KnownLog{"urg-ccny", 278, 681},
                                         KnownLog{"duke-loop5", 551, 181}));

TEST(GraphLog, CsailHasOneVertexPerScan) {
  const auto log = support::data_dir() / "csail-graph/csail-graph.log.gz";
  if (!std::filesystem::exists(log)) GTEST_SKIP() << "csail-graph is not there";
  const Recording r = read_log(log, "carmen", {{"poses", std::string("vertex")}, {"no_return_m", 81.8}}, sensor(), 1e9);
  EXPECT_EQ(r.observed.frames.size(), 1051U);
  EXPECT_EQ(r.observed.sensor.geometry.beams(), 361);
}

/// A turning scanner in the middle of a square room, 4 m wide: its ranges at n equal angles from -180 deg on.
std::string turn(int n) {
  std::string row;
  for (int i = 0; i < n; ++i) {
    const double a = radians(-180.0 + 360.0 * i / n);
    row += (i == 0 ? "" : " ") + std::to_string(2.0 / std::max(std::abs(std::cos(a)), std::abs(std::sin(a))));
  }
  return row + "\n";
}

const ParamSet kTurning = {{"first_angle_deg", -180.0}, {"span_deg", 360.0}};

ParamSet turning(const std::string& angles) {
  ParamSet params = kTurning;
  params["angles"] = angles;
  return params;
}

Recording rows(const std::string& text, const ParamSet& params) {
  return parse_log(text, "l.csv", "csv", params, sensor());
}

/// Every point of every scan is on the room's walls, if its angle is right.
void expect_points_on_walls(const Recording& recording, double tolerance_m) {
  for (std::size_t f = 0; f < recording.observed.frames.size(); ++f) {
    const Scan scan = recording.observed.scan(f);
    for (int i = 0; i < scan.beams(); ++i) {
      if (!scan.valid(i)) continue;
      EXPECT_NEAR(scan.point(i).cwiseAbs().maxCoeff(), 2.0, tolerance_m) << "scan " << f << " beam " << i;
    }
  }
}

TEST(ChangingBeams, AreRefusedUnlessTheOptionsAllowThem) {
  EXPECT_THAT(
      support::config_refusal([] { rows(turn(90) + turn(93), kTurning); }),
      HasSubstr("l.csv:2:1: 93 ranges, but the scan in line 1 has 90; allowed: one number of ranges in a log, or "
                "angles: resampled"));
  ParamSet both = kTurning;
  both["step_deg"] = 4.0;
  EXPECT_THAT(support::config_refusal([&] { rows(turn(90), both); }), HasSubstr("both step_deg and span_deg"));
}

TEST(ChangingBeams, AreResampledToTheNearestReading) {
  const Recording r = rows(turn(90) + turn(180) + turn(91), turning("resampled"));
  for (const Frame& frame : r.observed.frames) ASSERT_EQ(frame.ranges.size(), 90U);
  EXPECT_EQ(r.observed.frames[0].ranges, r.observed.frames[1].ranges);  // every second of twice as many is the same
  // A reading comes from at most half a step of its own scan away: 2 deg, which is 10 cm at the 2.83 m of a corner.
  expect_points_on_walls(r, 0.1);
  for (const double range : r.observed.frames[2].ranges) EXPECT_TRUE(std::isfinite(range));  // the turn has no gap
}

TEST(ChangingBeams, ABeamWithoutAReadingNearByHasNone) {
  // 0 .. 90 deg in steps of 10, then 0 .. 40 deg.
  const std::string text = "1 2 3 4 5 6 7 8 9 10\n1 2 3 4 5\n";
  const Recording r = rows(text, {{"first_angle_deg", 0.0}, {"step_deg", 10.0}, {"angles", std::string("resampled")}});
  EXPECT_EQ(r.observed.frames[1].ranges[4], 5.0);
  for (std::size_t i = 5; i < 10; ++i) EXPECT_TRUE(std::isnan(r.observed.frames[1].ranges[i])) << i;
}

TEST(ChangingBeams, AHugeFirstScanBeforeSmallOnesIsRefusedBeforeItFillsTheMemory) {
  std::string text;
  for (int i = 0; i < 300000; ++i) text += "1 ";
  text += "\n";
  for (int i = 0; i < 100; ++i) text += "1 2\n";
  EXPECT_THAT(support::config_refusal([&] { rows(text, turning("resampled")); }), HasSubstr("times the mean"));
}

}  // namespace
}  // namespace scanbench::io
