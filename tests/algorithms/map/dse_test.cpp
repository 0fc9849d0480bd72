// The mapper as a whole where its parameters are extreme.
#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "core/modules.hpp"
#include "core/registry.hpp"
#include "tests/support/aligning.hpp"
#include "tests/support/scan_builder.hpp"

namespace scanbench {
namespace {

/// Lines of the map after exact scans of a room from three places.
std::vector<std::size_t> lines_after_each_scan(const ParamSet& params, std::size_t& scan_lines) {
  const auto mapper = Registry<Mapper>::make("dse", params);
  std::vector<std::size_t> lines;
  Trace silent;
  scan_lines = 0;
  for (int k = 0; k < 3; ++k) {
    const Pose2 pose(0.3 * k, 0.1 * k, 0.2 * k);
    support::ScanSeries series;
    series.add_exact(support::cast(support::ring_sensor(361, 0.0), support::box(-3, -2, 4, 2), pose));
    const Observation scan = series.observations().front();
    scan_lines += scan.lines.lines.size();
    mapper->insert(scan, pose, silent);
    lines.push_back(mapper->map().lines.size());
  }
  return lines;
}

TEST(Dse, AtThresholdsZeroTheMapIsAllSegmentsOfAllScans) {
  std::size_t scan_lines = 0;
  const auto lines = lines_after_each_scan(
      {{"pairing_threshold_m", 0.0}, {"simplification_threshold_m", 0.0}, {"alignment", "none"}}, scan_lines);
  EXPECT_EQ(lines.back(), scan_lines);
}

TEST(Dse, WithThePapersThresholdsTheWallsOfARoomAreNotRepeated) {
  std::size_t scan_lines = 0;
  const auto lines = lines_after_each_scan({{"alignment", "none"}}, scan_lines);
  EXPECT_GE(lines.back(), 4u);
  EXPECT_LT(lines.back(), scan_lines);
  EXPECT_EQ(lines[2], lines[1]);
}

}  // namespace
}  // namespace scanbench
