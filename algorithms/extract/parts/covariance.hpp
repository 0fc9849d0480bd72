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

/// tls_covariance() if the points agree with it, else the larger of it and of what they show themselves, in each
/// direction. An extractor admits points of the next wall at a corner, and one line may cover several walls that are
/// nearly on one line; no noise model includes either. The line is therefore fitted again without each fifth of its
/// support: a jackknife over blocks, which includes errors that neighbours share (Kuensch 1989, "The jackknife and the
/// bootstrap for general stationary observations", section 2.1). Absent also if a fifth determines the direction alone.
/// On a plain wall it is cautious: the squared error over it has the mean 1.6 in place of 2. `support` is in order
/// along the line.
std::optional<Eigen::Matrix2d> checked_covariance(const Scan& scan, const ScanPoints& points,
                                                  std::span<const int> support, const PolarLine& line, const Vec2& at);

/// Sets the covariance of each line at its segment's midpoint. The lines must be total-least-squares fits to the points
/// with their labels.
void add_covariances(const Scan& scan, const ScanPoints& points, ScanLines& lines);

}  // namespace scanbench::extract
