// Sensor presets against the data sheets and papers, and errors of overridden fields.
#include "sim/sensors.hpp"

#include <cstdint>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/geometry/angles.hpp"
#include "core/params.hpp"
#include "core/sensor_model.hpp"

namespace scanbench::sim {
namespace {

using ::testing::HasSubstr;

struct Sheet {
  const char* preset;
  int beams;
  double first_deg;
  double last_deg;
  double range_min_m;
  double range_max_m;
};

TEST(Sensors, PresetsHaveTheBeamsEndAnglesAndRangesOfTheirSheets) {
  const Sheet sheets[] = {
      {"ladar_2d30", 451, -135.0, 135.0, 0.0, 30.0},
      {"urg_04lx", 682, -119.53125, (725 - 384) * 360.0 / 1024.0, 0.02, 4.095},  // steps 44 .. 725, front 384
      {"sick_pls101", 361, -90.0, 90.0, 0.07, 50.0},
      {"sick_lms200", 361, -90.0, 90.0, 0.0, 8.19},
      {"sick_lms200_cm", 361, -90.0, 90.0, 0.0, 81.9},
      {"dual_lms291", 720, -180.0, 179.5, 0.0, 80.0},
      {"fov110", 221, -55.0, 55.0, 0.0, 30.0},
      {"fov360", 720, -180.0, 179.5, 0.0, 1e9},
  };
  for (const Sheet& sheet : sheets) {
    const SensorModel sensor = make_sensor(sheet.preset, {});
    EXPECT_EQ(sensor.name, sheet.preset);
    EXPECT_FALSE(sensor.source.empty());
    EXPECT_EQ(sensor.geometry.beams(), sheet.beams) << sheet.preset;
    EXPECT_NEAR(degrees(sensor.geometry.angle(0)), sheet.first_deg, 1e-9) << sheet.preset;
    EXPECT_NEAR(degrees(sensor.geometry.angle(sheet.beams - 1)), sheet.last_deg, 1e-9) << sheet.preset;
    EXPECT_EQ(sensor.range_min_m, sheet.range_min_m);
    EXPECT_EQ(sensor.range_max_m, sheet.range_max_m);
  }
}

TEST(Sensors, NoiseOfThePresets) {
  EXPECT_EQ(make_sensor("ladar_2d30", {}).noise.gaussian_sigma(20.0), 0.05);
  // 1 cm to 1 m, then 1 % of the range; sigma is half of it.
  const SensorModel urg = make_sensor("urg_04lx", {});
  EXPECT_EQ(urg.noise.gaussian_sigma(0.5), 0.005);
  EXPECT_NEAR(urg.noise.gaussian_sigma(4.0), 0.02, 1e-15);
  EXPECT_EQ(urg.noise.quantum_m, 0.001);
  EXPECT_EQ(urg.scan_period_s, 0.1);
  const SensorModel pls = make_sensor("sick_pls101", {});
  EXPECT_EQ(pls.noise.sigma_m, 0.02);
  EXPECT_EQ(pls.noise.quantum_m, 0.05);
  EXPECT_NEAR(pls.time_per_beam_s * 360, 0.02, 1e-12);  // half a turn at 25 Hz
  EXPECT_EQ(make_sensor("dual_lms291", {}).noise.dropout_probability, 0.18);
}

TEST(Sensors, EveryFieldCanBeOverriddenAndTheEffectiveSetMakesTheSameSensor) {
  ParamSet effective;
  const SensorModel sensor = make_sensor(
      "ladar_2d30", {{"beams", std::int64_t{7}}, {"sigma_m", std::int64_t{0}}, {"bearing_sigma_deg", 0.1}}, &effective);
  EXPECT_EQ(sensor.geometry.beams(), 7);
  EXPECT_EQ(sensor.noise.sigma_m, 0.0);
  EXPECT_EQ(sensor.noise.bearing_sigma_rad, radians(0.1));
  EXPECT_EQ(effective.size(), sensor_param_specs().size());
  const SensorModel again = make_sensor("custom", effective);
  EXPECT_EQ(again.geometry.angle_min(), sensor.geometry.angle_min());
  EXPECT_EQ(again.geometry.angle_step(), sensor.geometry.angle_step());
  EXPECT_EQ(again.geometry.beams(), 7);
  EXPECT_EQ(again.noise.bearing_sigma_rad, sensor.noise.bearing_sigma_rad);
}

std::string complaint(const std::string& preset, const ParamSet& overrides) {
  try {
    make_sensor(preset, overrides);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "no error";
}

TEST(Sensors, FaultsAreNamed) {
  EXPECT_THAT(complaint("urg_04l", {}),
              HasSubstr("unknown sensor preset 'urg_04l'; did you mean 'urg_04lx'? known: custom, "));
  EXPECT_THAT(complaint("urg_04lx", {{"sigma_relative", 0.0}}),
              HasSubstr("have no noise; allowed: relative_from_m: 0"));
  EXPECT_EQ(complaint("urg_04lx", {{"sigma_relative", 0.0}, {"sigma_m", 0.0}}), "no error");
  EXPECT_THAT(complaint("urg_04lx", {{"sigma", 1.0}}), HasSubstr("did you mean 'sigma_m'"));
  EXPECT_THAT(complaint("urg_04lx", {{"sigma_m", -1.0}}), HasSubstr("sigma_m"));
  EXPECT_THAT(complaint("custom", {{"range_min_m", 40.0}}), HasSubstr("range_min_m is 40; allowed: less than"));
  EXPECT_THAT(complaint("custom", {{"beams", std::int64_t{721}}}), HasSubstr("span 360 deg"));
  EXPECT_THAT(complaint("custom", {{"angle_step_deg", 0.0}}), HasSubstr("angle_step_deg is 0"));
  EXPECT_THAT(complaint("custom", {{"time_per_beam_s", 0.01}}), HasSubstr("makes a sweep of 3.6 s"));
}

TEST(Sensors, EveryPresetSatisfiesTheBoundsOfItsFields) {
  for (const auto& [name, preset] : sensor_presets()) {
    EXPECT_EQ(name, preset.name);
    EXPECT_FALSE(preset.summary.empty());
    ParamSet effective;
    EXPECT_NO_THROW(make_sensor(name, {}, &effective)) << name;
    EXPECT_EQ(effective, preset.params) << name;
  }
}

}  // namespace
}  // namespace scanbench::sim
