// Valid returns of a scan, its geometry, and the noise of a data sheet.
#include "core/scan.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "core/special_values.hpp"

namespace scanbench {
namespace {

TEST(ValidPoints, KeepTheBeamNumberOfEveryReturn) {
  SensorModel sensor;
  sensor.geometry = ScanGeometry(0.0, kPi / 2, 6);
  const std::vector<double> ranges = {1.0, kInf, -kInf, std::nan(""), 2.0, 0.0};
  const ScanPoints points = valid_points({sensor, ranges});
  ASSERT_EQ(points.beams, (std::vector<int>{0, 4}));
  EXPECT_NEAR((points.points[0] - Vec2(1, 0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((points.points[1] - Vec2(2, 0)).norm(), 0.0, 1e-15);
}

TEST(ScanGeometry, RefusesANegativeNumberOfBeams) {
  EXPECT_THROW(ScanGeometry(0, 0.1, -1), ParamError);
  EXPECT_THROW(ScanGeometry(std::nan(""), 0.1, 3), ParamError);
  EXPECT_EQ(ScanGeometry(0, 0.1, 0).beams(), 0);
}

TEST(SensorNoise, AddsItsPartsInQuadrature) {
  SensorNoise noise{.sigma_m = 0.03, .sigma_relative = 0.01, .quantum_m = 0.05};
  EXPECT_NEAR(noise.gaussian_sigma(4.0), 0.05, 1e-15);
  EXPECT_NEAR(noise.range_sigma(4.0), std::sqrt(0.0025 + 0.0025 / 12), 1e-15);
}

TEST(SensorNoise, SwitchesToTheProportionalPartWhereTheDataSheetDoes) {
  const SensorNoise urg{.sigma_m = 0.005, .sigma_relative = 0.005, .relative_from_m = 1.0};
  EXPECT_DOUBLE_EQ(urg.gaussian_sigma(0.5), 0.005);
  EXPECT_DOUBLE_EQ(urg.gaussian_sigma(3.0), 0.015);
}

}  // namespace
}  // namespace scanbench
