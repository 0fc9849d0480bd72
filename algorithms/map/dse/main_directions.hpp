// The main directions of a map: significant peaks of the cyclic, length-weighted histogram of the directions of its
// segments (Lakaemper, Latecki & Wolter 2005, section 2.2).
#pragma once

#include <array>
#include <vector>

#include "core/geometry/geometry.hpp"

namespace scanbench::mapping::dse {

/// 180 bins of one degree; a direction belongs to the bin round(degrees) mod 180, so that 179.6 and 0.4 degrees share
/// one.
class DirectionHistogram {
 public:
  static constexpr int kBins = 180;
  static constexpr int kHalfWindow = 2;  ///< a window of 5 around bin 1 has the bins 179, 0, 1, 2, 3

  /// Adds a segment with its length as weight. One without length changes nothing.
  void add(const Segment& segment);

  double total_m() const { return total_m_; }
  double weight_m(int bin) const { return weight_m_[wrapped(bin)]; }
  /// Sum over the window around a bin, cyclic.
  double window_m(int bin) const;
  /// Length-weighted mean of the directions themselves in the window around a bin, in [0, pi).
  double mean_direction(int bin) const;

 private:
  static std::size_t wrapped(int bin) { return static_cast<std::size_t>((bin % kBins + kBins) % kBins); }

  std::array<double, kBins> weight_m_{};
  std::array<Vec2, kBins> doubled_ = zeros();  ///< sums of length * (cos 2t, sin 2t)
  double total_m_ = 0.0;
  static std::array<Vec2, kBins> zeros();
};

struct MainDirection {
  double angle_rad = 0.0;  ///< in [0, pi)
  double weight_m = 0.0;   ///< length of the segments in the window
};

/// Which peaks are significant; the paper does not say.
struct PeakRule {
  double least_share = 0.10;  ///< of the total length, in a window
  double apart_rad = 0.0;     ///< smallest distance from a stronger peak
};

/// Peaks by decreasing weight; of equal ones the bin nearest to 0 first. Empty for an empty histogram and for one
/// without a significant peak.
std::vector<MainDirection> main_directions(const DirectionHistogram& histogram, const PeakRule& rule);

}  // namespace scanbench::mapping::dse
