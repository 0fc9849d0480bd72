// Errors of matched lines in bins of some quantity (range, bound), with intervals over seeds.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

namespace scanbench::results {

/// Summary of one bin.
struct ErrorPoint {
  double x = 0.0;    ///< mean of the quantity
  double rms = 0.0;  ///< root mean square error of every seed, geometric mean over the seeds
  double low = 0.0;  ///< 95 % interval of that mean, symmetric on a logarithmic scale
  double high = 0.0;
  double bound = 0.0;  ///< root mean square of the bounds
  std::int64_t count = 0;
};

class ErrorBins {
 public:
  /// Bins [edge_k, edge_k+1) at edge_k = first * ratio^k, for all whole k, also negative ones.
  ErrorBins(double first, double ratio);

  /// Observations with x <= 0 or values that are not finite are skipped.
  void add(std::uint64_t seed, double x, double error, double bound);

  /// Bins with at least `least` observations, by increasing x.
  std::vector<ErrorPoint> points(std::int64_t least) const;

 private:
  struct Sums {
    double x = 0.0;
    double squared_error = 0.0;
    double squared_bound = 0.0;
    std::int64_t count = 0;
  };
  double first_;
  double log_ratio_;
  std::map<int, std::map<std::uint64_t, Sums>> bins_;
};

}  // namespace scanbench::results
