// Removal of spurious returns; code lengths and weights of the others. docs/algorithms/optimal.md, section 2.
#include "algorithms/extract/parts/scan_model.hpp"

#include <algorithm>
#include <cmath>

#include "algorithms/extract/parts/beam_line.hpp"
#include "core/special_values.hpp"

namespace scanbench::extract {
namespace {

const double kRootTwoPi = std::sqrt(kTwoPi);

// Every real sensor misses some beams. With this value two missing beams do not end a wall; three do.
constexpr double kLeastDropout = 0.01;

double median_of_three(double a, double b, double c) {
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

double median_of_five(std::span<const double> ranges, std::size_t i) {
  const std::size_t n = ranges.size();
  if (n < 5) return ranges[i];
  const double* w = &ranges[std::min(i < 2 ? 0 : i - 2, n - 5)];
  // The least and the greatest of four numbers are not the median of five.
  const double low = std::max(std::min(w[0], w[1]), std::min(w[2], w[3]));
  const double high = std::min(std::max(w[0], w[1]), std::max(w[2], w[3]));
  return median_of_three(low, high, w[4]);
}

}  // namespace

ScanModel::ScanModel(const Scan& scan, const SensorNoise& noise)
    : scan_(scan), noise_(noise), points_(valid_points(scan)) {
  ranges_.reserve(points_.size());
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
  const double clutter_cost = std::log(2.0 * span);
  const ReadingNoise noise = noise_;
  double variance = 0.0, line_cost = 0.0;  // of the point before; most sensors have the same everywhere
  for (std::size_t i = 0; i < size(); ++i) {
    const bool known = !walls.empty() && walls[i].range > 0;
    const double r = known ? walls[i].range : smoothed_range(i);
    if (const double here = noise.variance(r, known ? walls[i].slope : 0.0); here != variance) {
      variance = here;
      line_cost = 0.5 * std::log(variance * kTwoPi);
    }
    SegmentationPoint& p = result[i];
    p.direction = direction(i);
    p.inverse_range = 1.0 / ranges_[i];
    p.weight = ranges_[i] * r * r * r / variance;
    p.line_cost = line_cost;
    p.clutter_cost = clutter_cost;
    p.gap_cost = i > 0 ? gap_cost(i) : 0.0;
  }
  return result;
}

}  // namespace scanbench::extract
