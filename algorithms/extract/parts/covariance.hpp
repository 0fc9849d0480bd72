// Covariance of a total-least-squares line: the noise of its readings propagated through the fit to first order. Arras
// & Siegwart 1997, "Feature extraction and scene interpretation for map-based navigation and map building", section 2;
// here with noise along the beam instead of across the line.
//
// A covariance is valid only if the extractor admits points by the noise of the sensor, so that the residuals have this
// noise. In sef, iepf, line_tracking, kovesi, smf and fuzzy_lines the tolerance is a parameter, and their lines may
// contain a bend many standard deviations deep. line_regression locates corners only to half a window. These extractors
// report no covariance.
#pragma once

#include <optional>
#include <span>

#include <Eigen/Core>

#include "algorithms/extract/parts/groups.hpp"

namespace scanbench::extract {

/// Covariance of (offset at `at` along the canonical normal [m], angle counter-clockwise [rad]) of the total-least-
/// squares line through `support` (indices into points), by the sensor's data sheet. With tau the coordinate of a point
/// along the line from the centroid and h its error across the line,
///   offset at the centroid = mean of h,   angle = -sum(tau h) / sum(tau^2),
///   var h = (sigma_range cos(incidence))^2 + (range sigma_bearing sin(incidence))^2.
/// `line` is the fitted line, `at` a point on it. Absent for a sensor without stated noise, and if the support is so
/// short compared with its noise that the first order is not valid (sum(tau^2) <= 10 sum(var h)).
std::optional<Eigen::Matrix2d> tls_covariance(const Scan& scan, const ScanPoints& points, std::span<const int> support,
                                              const PolarLine& line, const Vec2& at);

/// tls_covariance() if the points at both ends of the support agree with the others. At a corner an extractor admits
/// points of the next wall that happen to be within its tolerance, and no noise model includes them. The line is
/// therefore fitted again without up to a fifth of its points at each end. If it moves by more than the noise explains,
/// the ends are foreign: the covariance is then that of the trimmed line plus the square of the movement. Absent also
/// if the trimmed support determines no line. `support` is in order along the line.
std::optional<Eigen::Matrix2d> checked_covariance(const Scan& scan, const ScanPoints& points,
                                                  std::span<const int> support, const PolarLine& line, const Vec2& at);

/// Sets the covariance of each line at its segment's midpoint. The lines must be total-least-squares fits to the points
/// with their labels.
void add_covariances(const Scan& scan, const ScanPoints& points, ScanLines& lines);

}  // namespace scanbench::extract
