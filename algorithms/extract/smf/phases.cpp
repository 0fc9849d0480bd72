// The split and the merge phase of SMF, Borges & Aldon 2000, section 3. docs/algorithms/smf.md lists what the paper
// leaves open.
#include "algorithms/extract/smf/phases.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "algorithms/extract/parts/groups.hpp"
#include "core/index.hpp"

namespace scanbench::extract {
namespace {

using Members = std::vector<int>;
using Lines = std::vector<SmfLine>;

/// The lines before a generation of splits.
struct GenerationRow {
  static constexpr std::string_view kName = "smf_generation_lines";
  int lines = 0;
  static constexpr auto columns() { return std::tuple{column("lines", &GenerationRow::lines)}; }
};

/// The lines after a round of merging.
struct MergeRow {
  static constexpr std::string_view kName = "smf_merge_lines";
  int lines = 0;
  static constexpr auto columns() { return std::tuple{column("lines", &MergeRow::lines)}; }
};

SmfLine line_of(std::span<const Vec2> points, Members support) {
  SmfLine line;
  line.support = std::move(support);
  line.moments = moments_of(points, line.support);
  return line;
}

// Split phase.

std::pair<Members, Members> halves(const Members& order, std::size_t first) {
  const auto middle = order.begin() + static_cast<std::ptrdiff_t>(first);
  std::pair<Members, Members> result{{order.begin(), middle}, {middle, order.end()}};
  std::sort(result.first.begin(), result.first.end());
  std::sort(result.second.begin(), result.second.end());
  return result;
}

std::pair<Members, Members> initial_halves(std::span<const Vec2> points, const SmfLine& line, SmfInitialisation kind) {
  const Members& q = line.support;
  const auto at = [&](int j) { return points[as_index(j)]; };
  switch (kind) {
    case SmfInitialisation::scan_order:
      break;
    case SmfInitialisation::principal_axis: {
      const Vec2 along = perpendicular(fit_line(line.moments).normal);
      Members order = q;
      std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return along.dot(at(a)) < along.dot(at(b)); });
      return halves(order, q.size() / 2);
    }
    case SmfInitialisation::farthest: {
      const Vec2 a = at(q.front());
      const Vec2 chord = at(q.back()) - a;
      std::size_t farthest = q.size() / 2;
      double largest = 0.0;
      for (std::size_t k = 1; k + 1 < q.size(); ++k) {
        // A closed contour has no chord: the distance is measured from its end.
        const Vec2 d = at(q[k]) - a;
        const double away = chord.squaredNorm() > 0 ? std::fabs(cross(chord, d)) : d.squaredNorm();
        if (away > largest) {
          largest = away;
          farthest = k;
        }
      }
      return halves(q, farthest);
    }
  }
  return halves(q, q.size() / 2);
}

// Step 3 (a): two lines from the support of one, by fuzzy clustering with C = 2. Each point goes to the prototype with
// the larger membership, or to the first if they are equal. Both lines are then refitted to their support by orthogonal
// least squares, so that sigma_k is the smallest possible, as in the merge phase.
std::pair<SmfLine, SmfLine> split(std::span<const Vec2> points, const SmfLine& line, const SmfOptions& options) {
  std::vector<Vec2> support;
  support.reserve(line.support.size());
  for (const int j : line.support) support.push_back(points[as_index(j)]);

  auto [first, second] = initial_halves(points, line, options.initialisation);
  const Vec2 normal = fit_line(line.moments).normal;
  const auto prototype = [&](const Members& half) {
    std::vector<Vec2> p;
    p.reserve(half.size());
    for (const int j : half) p.push_back(points[as_index(j)]);
    return prototype_of(p, normal);
  };
  const FuzzyLine initial[] = {prototype(first), prototype(second)};
  const FuzzyLines fuzzy = fuzzy_lines(support, initial, options.fuzzy);

  Members to_first, to_second;
  for (std::size_t j = 0; j < support.size(); ++j)
    (fuzzy.membership(0, j) >= fuzzy.membership(1, j) ? to_first : to_second).push_back(line.support[j]);
  if (to_first.empty() || to_second.empty())  // only one cluster was found; without this the split phase would not end
    return {line_of(points, std::move(first)), line_of(points, std::move(second))};
  return {line_of(points, std::move(to_first)), line_of(points, std::move(to_second))};
}

// Merge phase.

// The two lines whose centres are nearest to that of line k; -1 if there are fewer. Of equal ones the lower index.
std::pair<int, int> nearest_two(const Lines& lines, std::size_t k) {
  int a = -1, b = -1;
  double to_a = 0.0, to_b = 0.0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (i == k) continue;
    const double d = (lines[i].moments.centroid() - lines[k].moments.centroid()).squaredNorm();
    if (a < 0 || d < to_a) {
      b = a;
      to_b = to_a;
      a = static_cast<int>(i);
      to_a = d;
    } else if (b < 0 || d < to_b) {
      b = static_cast<int>(i);
      to_b = d;
    }
  }
  return {a, b};
}

// Length of the gap between the two supports along the fused line; negative if they overlap.
double gap_between(std::span<const Vec2> points, const SmfLine& a, const SmfLine& b, const LineFit& fused) {
  const Vec2 along = perpendicular(fused.normal);
  const auto extent = [&](const SmfLine& line) {
    double low = along.dot(points[as_index(line.support.front())]), high = low;
    for (const int j : line.support) {
      const double t = along.dot(points[as_index(j)]);
      low = std::min(low, t);
      high = std::max(high, t);
    }
    return std::pair(low, high);
  };
  const auto [low_a, high_a] = extent(a);
  const auto [low_b, high_b] = extent(b);
  return std::max(low_a, low_b) - std::min(high_a, high_b);
}

struct Fusion {
  std::size_t partner;
  double dispersion;
};

// The fusion of line k with one of its two candidates that has the smaller dispersion, if any is allowed.
std::optional<Fusion> best_fusion(std::span<const Vec2> points, const Lines& lines, std::size_t k,
                                  const SmfOptions& options) {
  const auto [a, b] = nearest_two(lines, k);
  std::optional<Fusion> best;
  for (const int candidate : {a, b}) {
    if (candidate < 0) continue;
    const auto i = as_index(candidate);
    PointMoments united = lines[k].moments;
    united.add(lines[i].moments);
    const double dispersion = smf_dispersion(united, options);
    if (!(dispersion <= options.sigma_max_m) || (best && best->dispersion <= dispersion)) continue;
    if (options.max_gap_m > 0 && gap_between(points, lines[k], lines[i], fit_line(united)) > options.max_gap_m)
      continue;
    best = Fusion{i, dispersion};
  }
  return best;
}

SmfLine fuse(std::span<const Vec2> points, const SmfLine& a, const SmfLine& b) {
  Members support(a.support.size() + b.support.size());
  std::merge(a.support.begin(), a.support.end(), b.support.begin(), b.support.end(), support.begin());
  return line_of(points, std::move(support));
}

}  // namespace

double smf_dispersion(const PointMoments& moments, const SmfOptions& options) {
  if (!(moments.weight() > 0)) return 0.0;
  const LineFit fit = fit_line(moments);
  double sum = options.penalty_in_dispersion ? moments.sxx() + moments.syy() : 0.0;
  if (moments.weight() > 2) sum += fit.residual_sum;  // the residual of two points is rounding errors
  return std::sqrt(sum / moments.weight());           // eq. (11)
}

std::vector<SmfLine> smf_split(std::span<const Vec2> points, const SmfOptions& options, Trace& trace) {
  Lines lines;
  if (points.empty()) return lines;
  Members all(points.size());
  std::iota(all.begin(), all.end(), 0);
  lines.push_back(line_of(points, std::move(all)));  // step 1
  for (bool again = true; again;) {                  // steps 2 to 4: a generation
    trace.row(GenerationRow{static_cast<int>(lines.size())});
    again = false;
    for (std::size_t k = 0, count = lines.size(); k < count; ++k) {
      if (lines[k].support.size() <= 2 || smf_dispersion(lines[k].moments, options) <= options.sigma_max_m) continue;
      auto [first, second] = split(points, lines[k], options);
      lines[k] = std::move(first);
      lines.push_back(std::move(second));
      again = true;
    }
  }
  return lines;
}

std::vector<SmfLine> smf_merge(std::span<const Vec2> points, std::vector<SmfLine> lines, const SmfOptions& options,
                               Trace& trace) {
  // The paper gives no order. List order with a restart at the fused line is deterministic. It ends, because every
  // fusion shortens the list.
  for (bool fused = true; fused;) {
    fused = false;
    for (std::size_t k = 0; k < lines.size();) {
      const std::optional<Fusion> best = best_fusion(points, lines, k, options);
      if (!best) {
        ++k;
        continue;
      }
      const std::size_t low = std::min(k, best->partner);
      const std::size_t high = std::max(k, best->partner);
      lines[low] = fuse(points, lines[low], lines[high]);
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(high));
      k = low;
      fused = true;
    }
    trace.row(MergeRow{static_cast<int>(lines.size())});
  }
  return lines;
}

}  // namespace scanbench::extract
