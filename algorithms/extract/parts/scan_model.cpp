// Removal of spurious returns; code lengths and weights of the others. docs/algorithms/optimal.md, section 2.
#include "algorithms/extract/parts/scan_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "algorithms/extract/parts/beam_line.hpp"
#include "core/special_values.hpp"

namespace scanbench::extract {
namespace {

const double kRootTwoPi = std::sqrt(kTwoPi);

// Every real sensor misses some beams. With this value two missing beams do not end a wall; three do.
constexpr double kLeastDropout = 0.01;

double median_of_five(std::span<const double> ranges, std::size_t i) {
  const std::size_t n = ranges.size();
  if (n < 5) return ranges[i];
  const std::size_t begin = std::min(i < 2 ? 0 : i - 2, n - 5);
  std::array<double, 5> w{};
  std::copy_n(ranges.begin() + static_cast<std::ptrdiff_t>(begin), 5, w.begin());
  std::nth_element(w.begin(), w.begin() + 2, w.end());
  return w[2];
}

}  // namespace

ScanModel::ScanModel(const Scan& scan, const SensorNoise& noise)
    : scan_(scan), noise_(noise), points_(valid_points(scan)) {
  for (const Vec2& p : points_.points) ranges_.push_back(p.norm());
  if (!(noise.spurious_probability > 0) || size() < 5) return;
  ScanPoints kept;
  std::vector<double> kept_ranges;
  for (std::size_t i = 0; i < size(); ++i) {
    const double around = smoothed_range(i);
    const double sigma = reading_sigma(noise, around, 0.0);
    // Skips a reading if its code as a spurious return, uniform up to the wall, is shorter than its code as an error.
    const double nats = std::log(1.0 / noise.spurious_probability) + std::log(around / (sigma * kRootTwoPi));
    if (around - ranges_[i] > sigma * std::sqrt(2.0 * std::max(nats, 2.0))) continue;
    kept.beams.push_back(points_.beams[i]);
    kept.points.push_back(points_.points[i]);
    kept_ranges.push_back(ranges_[i]);
  }
  points_ = std::move(kept);
  ranges_ = std::move(kept_ranges);
}

double ScanModel::smoothed_range(std::size_t i) const {
  return median_of_five(ranges_, i);
}

double ScanModel::place_cost() const {
  return std::log(static_cast<double>(size()));
}

// Code length of the missing beams between points i-1 and i if one line continues across them.
double ScanModel::gap_cost(std::size_t i) const {
  int missing = 0;
  for (int b = points_.beams[i - 1] + 1; b < points_.beams[i]; ++b) missing += scan_.valid(b) ? 0 : 1;
  if (missing == 0) return 0.0;
  const Vec2 chord = points_.points[i] - points_.points[i - 1];
  const double cos_incidence = std::fabs(cross(chord, direction(i))) / std::max(chord.norm(), 1e-12);
  const double oblique = 1.0 - std::min(cos_incidence, 1.0);
  const double p = std::clamp(noise_.dropout_probability + noise_.dropout_grazing * oblique * oblique, kLeastDropout,
                              1.0 - kLeastDropout);
  const double nats = -missing * std::log(p);
  // No line continues if the code is longer than that of an opening, the places where it begins and ends.
  return nats > 2.0 * place_cost() ? kInf : nats;
}

std::vector<SegmentationPoint> ScanModel::segmentation_points(std::span<const KnownWall> walls) const {
  std::vector<SegmentationPoint> result(size());
  if (result.empty()) return result;
  const double span = std::max(*std::max_element(ranges_.begin(), ranges_.end()), 1.0);
  for (std::size_t i = 0; i < size(); ++i) {
    const bool known = !walls.empty() && walls[i].range > 0;
    const double r = known ? walls[i].range : smoothed_range(i);
    const double sigma = reading_sigma(noise_, r, known ? walls[i].slope : 0.0);
    SegmentationPoint& p = result[i];
    p.direction = direction(i);
    p.inverse_range = 1.0 / ranges_[i];
    p.weight = ranges_[i] * r * r * r / (sigma * sigma);
    p.line_cost = std::log(sigma * kRootTwoPi);
    p.clutter_cost = std::log(2.0 * span);
    p.gap_cost = i > 0 ? gap_cost(i) : 0.0;
  }
  return result;
}

}  // namespace scanbench::extract
