// An interval for the change of a mean over the scans of one recording, whose neighbours resemble each other.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "harness/results/analysis/statistics.hpp"

namespace scanbench::results {

/// What one scan adds to a mean in two runs. Weight 0: the scan has no value in that run.
struct ScanPair {
  double before = 0.0;
  double weight_before = 0.0;
  double after = 0.0;
  double weight_after = 0.0;
};

enum class ScanMean {
  mean,              ///< sum of weight * value over sum of weights
  root_mean_square,  ///< the root of that mean of the squares
};

/// The length of blocks for a series, from the lag at which its autocorrelation vanishes: Politis and White, "Automatic
/// block-length selection for the dependent bootstrap", Econometric Reviews 23, 2004, for blocks of fixed length. From
/// 1 to a third of the series; 1 for a series without spread.
std::size_t block_length(std::span<const double> series);

struct BlockInterval {
  MeanInterval difference{};  ///< mean after - mean before; `count` is the number of scans
  MeanInterval worsening{};   ///< cost(mean after) - cost(mean before)
  double p = 1.0;             ///< two-sided, of no worsening; NaN if the worsening is not defined
  double effect = 0.0;        ///< the difference over the standard deviation of what single scans add to it; NaN: none
  std::size_t block = 1;      ///< length of the blocks
};

/// Fewer scans than this have no interval.
inline constexpr std::size_t kLeastScans = 12;

/// The change of a mean from scans in their order, with 95 % intervals from the seeded moving-block bootstrap (Künsch,
/// "The jackknife and the bootstrap for general stationary observations", Annals of Statistics 17, 1989): pairs are
/// drawn in blocks of neighbours, and both means are computed from the drawn pairs. The interval is the wider, at each
/// end, of the percentiles and of Student's t interval with the bootstrap's standard error and as many degrees of
/// freedom as there are whole blocks, less one, because the percentiles of a few blocks are too narrow. Pairs that are
/// equal to the bit give exactly zero. Needs at least kLeastScans pairs and, in each run, one weight above 0.
BlockInterval block_interval(std::span<const ScanPair> pairs, ScanMean mean, const std::function<double(double)>& cost);

}  // namespace scanbench::results
