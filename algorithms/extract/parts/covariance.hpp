// How sure a total-least-squares line is: the noise of its readings carried through the fit to first order. Arras &
// Siegwart 1997, "Feature extraction and scene interpretation for map-based navigation and map building", section 2;
// here with noise along the beam instead of across the line.
//
// Well founded only where an extractor admits points by the sensor's own noise, so that what is left about the line is
// that noise. Extractors whose tolerance is the user's (sef, iepf, line_tracking, kovesi, smf, fuzzy_lines) may have a
// bend many standard deviations deep in a line, and line_regression knows its corners to half a window only: they
// report none.
#pragma once

#include <optional>
#include <span>

#include <Eigen/Core>

#include "algorithms/extract/parts/groups.hpp"

namespace scanbench::extract {

/// Covariance of (offset at `at` along the canonical normal [m], angle counter-clockwise [rad]) of the total-least-
/// squares line through `support` (indices into points), by the sensor's data sheet: with tau the place of a point
/// along the line from the centroid and h its error across it,
///   offset at the centroid = mean of h,   angle = -sum(tau h) / sum(tau^2),
///   var h = (sigma_range cos(incidence))^2 + (range sigma_bearing sin(incidence))^2.
/// `line` is the fitted line, `at` lies on it. Absent for a sensor without a stated noise, and where the first order
/// does not hold: a support whose extent is not clear of its noise (sum(tau^2) <= 10 sum(var h)).
std::optional<Eigen::Matrix2d> tls_covariance(const Scan& scan, const ScanPoints& points, std::span<const int> support,
                                              const PolarLine& line, const Vec2& at);

/// Gives each line, fitted by total least squares to the points with its label, its covariance at the segment's
/// midpoint.
void add_covariances(const Scan& scan, const ScanPoints& points, ScanLines& lines);

}  // namespace scanbench::extract
