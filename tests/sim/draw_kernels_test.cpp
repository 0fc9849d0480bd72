// Random numbers drawn in lanes against those drawn one by one, bit for bit, on every processor's kernels.
#include "sim/lanes/draw_kernels.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "core/isa.hpp"
#include "core/rng.hpp"
#include "core/sensor_model.hpp"
#include "sim/noise.hpp"

namespace scanbench::sim {
namespace {

std::vector<const DrawKernels*> kernels_of_this_processor() {
  std::vector<const DrawKernels*> kernels{&baseline::kDrawKernels};
  if (best_isa() == Isa::v3) kernels.push_back(&v3::kDrawKernels);
  return kernels;
}

TEST(DrawKernels, GiveTheFirstNumbersOfEachBeamsGenerator) {
  std::vector<std::uint32_t> beams(4096);
  std::iota(beams.begin(), beams.end(), 0U);
  for (std::size_t i = 0; i < 8; ++i) beams[i * 7] = 0xffffffffU - static_cast<std::uint32_t>(i);
  for (const DrawKernels* kernels : kernels_of_this_processor())
    for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{0xfedcba9876543210}})
      for (const std::uint32_t frame : {0U, 1U, 0xffffffffU}) {
        std::vector<double> uniforms(beams.size());
        std::vector<double> normals(beams.size());
        kernels->uniforms({seed, static_cast<std::uint32_t>(RngStream::dropout), frame, beams.data()}, 4096,
                          uniforms.data());
        kernels->normals({seed, static_cast<std::uint32_t>(RngStream::range), frame, beams.data()}, 4096,
                         normals.data());
        for (std::size_t i = 0; i < beams.size(); ++i) {
          ASSERT_EQ(uniforms[i], CounterRng(seed, RngStream::dropout, frame, beams[i]).uniform()) << beams[i];
          ASSERT_EQ(normals[i], CounterRng(seed, RngStream::range, frame, beams[i]).normal()) << beams[i];
        }
      }
}

TEST(DrawKernels, AMillionNormalsAreThoseOfTheGenerators) {
  constexpr std::uint32_t kBeams = 4000;
  std::vector<std::uint32_t> beams(kBeams);
  std::iota(beams.begin(), beams.end(), 0U);
  std::vector<double> normals(kBeams);
  for (const DrawKernels* kernels : kernels_of_this_processor())
    for (std::uint32_t frame = 0; frame < 250; ++frame) {
      kernels->normals({7, static_cast<std::uint32_t>(RngStream::bearing), frame, beams.data()}, kBeams,
                       normals.data());
      for (std::uint32_t beam = 0; beam < kBeams; ++beam)
        ASSERT_EQ(normals[beam], CounterRng(7, RngStream::bearing, frame, beam).normal());
    }
}

// Every part of the noise on, then each alone.
std::vector<SensorModel> sensors() {
  SensorModel all;
  all.range_min_m = 0.5;
  all.range_max_m = 20.0;
  all.noise = {.sigma_m = 0.05,
               .sigma_relative = 0.01,
               .bearing_sigma_rad = 0.01,
               .quantum_m = 0.01,
               .dropout_probability = 0.1,
               .dropout_grazing = 0.5,
               .spurious_probability = 0.05};
  std::vector<SensorModel> models(4, all);
  models[1].noise = {.sigma_m = 0.05};
  models[2].noise = {.sigma_m = 0.005, .sigma_relative = 0.005, .relative_from_m = 1.0};
  models[3].noise = {.dropout_probability = 0.2};
  return models;
}

TEST(ScanNoise, ReadsWhatObservedRangeReadsBeamByBeam) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  constexpr std::size_t kBeams = 1003;
  CounterRng rng(3, RngStream::resampling);
  std::vector<double> ranges(kBeams);
  std::vector<double> cosines(kBeams);
  std::vector<double> readings(kBeams);
  for (const SensorModel& sensor : sensors())
    for (const Isa isa : {Isa::baseline, best_isa()}) {
      ScanNoise noise(sensor, 11, isa);
      for (std::uint32_t frame = 0; frame < 50; ++frame) {
        for (std::size_t i = 0; i < kBeams; ++i) {
          ranges[i] = rng.uniform() < 0.1 ? kInf : 25.0 * rng.uniform();
          cosines[i] = rng.uniform();
        }
        noise.observe(frame, ranges, cosines, readings);
        const auto bearings = noise.bearing_errors(frame, kBeams);
        for (std::size_t i = 0; i < kBeams; ++i) {
          const BeamAddress address{11, frame, static_cast<std::uint32_t>(i)};
          ASSERT_EQ(readings[i], observed_range(sensor, ranges[i], cosines[i], address));
          ASSERT_EQ(bearings.empty() ? 0.0 : bearings[i], bearing_error(sensor.noise, address));
        }
      }
    }
}

// These scans are read in lanes: the last group may be incomplete, and limits belong to the range of the sensor.
TEST(ScanNoise, AGaussianErrorAloneIsTheSameInScansOfAnyLength) {
  SensorModel sensor = sensors()[1];
  sensor.noise.sigma_m = 0.5;
  const double low = sensor.range_min_m, high = sensor.range_max_m;
  const double special[] = {0.0,
                            low,
                            std::nextafter(low, 0.0),
                            std::nextafter(low, high),
                            high,
                            std::nextafter(high, 100.0),
                            std::nextafter(high, 0.0),
                            std::numeric_limits<double>::infinity()};
  CounterRng rng(5, RngStream::resampling);
  for (const Isa isa : {Isa::baseline, best_isa()})
    for (std::uint32_t beams = 1; beams < 40; ++beams) {
      ScanNoise noise(sensor, 3, isa);
      std::vector<double> ranges(beams), readings(beams);
      for (double& range : ranges)
        range = rng.uniform() < 0.5 ? special[static_cast<std::size_t>(8 * rng.uniform())] : 22 * rng.uniform();
      noise.observe(beams, ranges, {}, readings);
      for (std::uint32_t i = 0; i < beams; ++i)
        ASSERT_EQ(readings[i], observed_range(sensor, ranges[i], 0.0, {3, beams, i})) << beams << " " << ranges[i];
    }
}

TEST(ScanNoise, ScansWithoutReturnsOrBeamsAreFine) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const SensorModel sensor = sensors()[0];
  ScanNoise noise(sensor, 1);
  std::vector<double> readings{1.0, 2.0, 3.0};
  noise.observe(0, std::vector<double>{kInf, 0.1, 100.0}, std::vector<double>(3, 1.0), readings);
  EXPECT_EQ(readings, (std::vector<double>{kInf, -kInf, kInf}));
  noise.observe(0, {}, {}, {});
  EXPECT_TRUE(noise.bearing_errors(0, 0).empty());
}

}  // namespace
}  // namespace scanbench::sim
