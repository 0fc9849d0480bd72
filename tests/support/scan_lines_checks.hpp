// Checks the promises of core/scan.hpp about a scan and the lines that any extractor finds in it.
#pragma once

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/index.hpp"
#include "core/modules.hpp"

namespace scanbench::support {

/// Expects everything that core/scan.hpp promises about LineFeature and ScanLines.
inline void expect_consistent(const Scan& scan, const ScanLines& result) {
  ASSERT_EQ(result.labels.size(), scan.ranges.size());
  const int lines = static_cast<int>(result.lines.size());
  std::vector<int> count(result.lines.size(), 0);
  std::vector<int> first(result.lines.size(), -1);
  std::vector<int> last(result.lines.size(), -1);
  for (int beam = 0; beam < scan.beams(); ++beam) {
    const int label = result.labels[as_index(beam)];
    ASSERT_GE(label, -1);
    ASSERT_LT(label, lines);
    if (label < 0) continue;
    ASSERT_TRUE(scan.valid(beam)) << "beam " << beam << " has no return but supports line " << label;
    const auto k = as_index(label);
    if (count[k]++ == 0) first[k] = beam;
    last[k] = beam;
  }
  for (std::size_t k = 0; k < result.lines.size(); ++k) {
    SCOPED_TRACE("line " + std::to_string(k));
    const LineFeature& f = result.lines[k];
    EXPECT_GE(f.points, 1);
    EXPECT_EQ(f.points, count[k]);
    EXPECT_EQ(f.first_beam, first[k]);
    EXPECT_EQ(f.last_beam, last[k]);
    EXPECT_LE(f.first_beam, f.last_beam);
    if (k > 0) {
      EXPECT_GT(f.first_beam, result.lines[k - 1].first_beam) << "lines come in scan order";
    }
    EXPECT_TRUE(f.segment.a.allFinite() && f.segment.b.allFinite());
    EXPECT_GE(f.line.rho, 0.0);
    EXPECT_TRUE(std::isfinite(f.line.rho));
    EXPECT_GT(f.line.alpha, -kPi);
    EXPECT_LE(f.line.alpha, kPi);
    EXPECT_GE(f.rms_m, 0.0);
    EXPECT_TRUE(std::isfinite(f.rms_m));
    for (const Vec2& end : {f.segment.a, f.segment.b})
      EXPECT_NEAR(f.line.signed_distance(end), 0.0, 1e-6 * (1.0 + end.norm())) << "an end off its line";
    if (!f.covariance) continue;
    EXPECT_TRUE(f.covariance->allFinite());
    EXPECT_NEAR((*f.covariance)(0, 1), (*f.covariance)(1, 0), 1e-12 + 1e-9 * f.covariance->norm());
    EXPECT_GE((*f.covariance)(0, 0), 0.0);
    EXPECT_GE((*f.covariance)(1, 1), 0.0);
    const double determinant = (*f.covariance)(0, 0) * (*f.covariance)(1, 1) - std::pow((*f.covariance)(0, 1), 2);
    EXPECT_GE(determinant, -1e-9 * (*f.covariance)(0, 0) * (*f.covariance)(1, 1));
  }
}

/// Expects the same answer to the last bit.
inline void expect_identical(const ScanLines& a, const ScanLines& b) {
  EXPECT_EQ(a.labels, b.labels);
  ASSERT_EQ(a.lines.size(), b.lines.size());
  for (std::size_t k = 0; k < a.lines.size(); ++k) {
    const LineFeature& x = a.lines[k];
    const LineFeature& y = b.lines[k];
    EXPECT_TRUE(x.segment == y.segment && x.line == y.line && x.covariance == y.covariance &&
                x.first_beam == y.first_beam && x.last_beam == y.last_beam && x.points == y.points &&
                x.rms_m == y.rms_m)
        << "line " << k;
  }
}

}  // namespace scanbench::support
