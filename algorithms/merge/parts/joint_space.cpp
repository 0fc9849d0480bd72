// Splits lines in an order that does not depend on the order of the input (Lakaemper 2009, section IV.A).
#include "algorithms/merge/parts/joint_space.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "core/index.hpp"
#include "core/number_text.hpp"

namespace scanbench::merge {
namespace {

/// All numbers of a line, the same for both orders of its ends.
std::array<double, 10> canonical_key(const MapLine& line) {
  std::array a{line.segment.a.x(), line.segment.a.y()};
  std::array b{line.segment.b.x(), line.segment.b.y()};
  if (b < a) std::swap(a, b);
  return {a[0],
          a[1],
          b[0],
          b[1],
          static_cast<double>(line.members),
          static_cast<double>(line.points),
          line.covariance(0, 0),
          line.covariance(0, 1),
          line.covariance(1, 0),
          line.covariance(1, 1)};
}

/// Largest absolute coordinate; NaN if any coordinate is NaN.
double extent(const Segment& s) {
  double largest = 0.0;
  for (const double v : {s.a.x(), s.a.y(), s.b.x(), s.b.y()}) {
    if (std::isnan(v)) return v;
    largest = std::max(largest, std::abs(v));
  }
  return largest;
}

}  // namespace

JointSpace split_lines(std::span<const MapLine> lines, double sigma_m, double longest_m) {
  JointSpace space;
  std::vector<std::pair<std::array<double, 10>, std::size_t>> order;
  double pieces = 0.0;
  double longest_line = 0.0;
  double farthest = 0.0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double reach = extent(lines[i].segment);
    const double length = lines[i].segment.length();
    if (!(reach <= kFarthest) || !(length > 0)) {
      ++space.unusable;
      continue;
    }
    pieces += std::max(1.0, std::ceil(length / longest_m));
    longest_line = std::max(longest_line, length);
    farthest = std::max(farthest, reach);
    order.emplace_back(canonical_key(lines[i]), i);
  }
  if (pieces > kMostPieces)
    throw ParamError("sigma_m", "sigma_m = " + number_text(sigma_m) + " m cuts the " + std::to_string(order.size()) +
                                    " lines (the longest " + number_text(longest_line) + " m) into pieces of " +
                                    number_text(longest_m) + " m, more than " + number_text(kMostPieces) +
                                    "; choose a larger sigma_m or split_length_sigma");
  if (farthest > kMostSigmas * sigma_m)
    throw ParamError("sigma_m", "sigma_m = " + number_text(sigma_m) + " m is too small for coordinates of " +
                                    number_text(farthest) + " m; allowed for these lines: at least " +
                                    number_text(farthest / kMostSigmas) + " m");
  // NaN in a covariance would make the sort undefined: such entries count as zero.
  for (auto& [key, index] : order)
    for (double& v : key)
      if (std::isnan(v)) v = 0.0;
  std::sort(order.begin(), order.end());

  space.pieces.reserve(static_cast<std::size_t>(pieces));
  for (const auto& [key, index] : order) {
    const Vec2 a(key[0], key[1]);
    const Vec2 b(key[2], key[3]);
    const double alpha = Segment{a, b}.direction_angle();
    const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil((b - a).norm() / longest_m)));
    const auto cut = [&](std::size_t k) {
      if (k == 0) return a;
      return k == count ? b : Vec2(a + (b - a) * (static_cast<double>(k) / static_cast<double>(count)));
    };
    for (std::size_t k = 0; k < count; ++k) space.pieces.push_back({{cut(k), cut(k + 1)}, alpha, index});
  }
  return space;
}

double mean_direction(std::span<const double> directions) {
  double c = 0.0;
  double s = 0.0;
  for (const double d : directions) {
    c += std::cos(
        2.0 * (d - directions.front()));  // relative to the first, so that equal directions give exactly that direction
    s += std::sin(2.0 * (d - directions.front()));
  }
  if (std::hypot(c, s) < 1e-9 * static_cast<double>(directions.size())) return direction_mod_pi(directions.front());
  return direction_mod_pi(directions.front() + 0.5 * std::atan2(s, c));
}

}  // namespace scanbench::merge
