// Fuzzy clustering of lines, Borges & Aldon 2000, section 2.3, equations (1) to (10).
//
// Departures from the printed text. Eq. (8) needs the two-argument arctangent: its condition has two solutions 90
// degrees apart, and the plain arctangent returns the worst line for every wall whose normal is more than 45 degrees
// from the x axis. For a point on a centre, eq. (6) is zero divided by zero; the point belongs to that prototype, which
// is the limit of the equation.
#include "algorithms/extract/parts/fuzzy_clustering.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "algorithms/extract/parts/fuzzy_kernels.hpp"
#include "core/geometry/least_squares.hpp"
#include "core/isa.hpp"
#include "core/params.hpp"

namespace scanbench::extract {
namespace {

// Eq. (4), f and g.
double squared_distance(const FuzzyLine& line, const Vec2& p, bool penalty) {
  const double f = line.rho - line.normal.dot(p);
  return f * f + (penalty ? (p - line.centre).squaredNorm() : 0.0);  // eq. (10)
}

// Eq. (6) for one point from its squared distances to all prototypes. Ratios to the smallest one cannot overflow, even
// for a fuzzifier near 1.
void memberships_of(std::span<const double> d2, double fuzzifier, std::span<double> u) {
  const double nearest = *std::min_element(d2.begin(), d2.end());
  double sum = 0.0;
  for (std::size_t i = 0; i < d2.size(); ++i) {
    if (nearest <= kZeroDistance2)
      u[i] = d2[i] <= kZeroDistance2 ? 1.0 : 0.0;
    else
      u[i] = fuzzifier == 2.0 ? nearest / d2[i] : std::pow(nearest / d2[i], 1.0 / (fuzzifier - 1.0));
    sum += u[i];
  }
  for (double& v : u) v /= sum;
}

double power(double u, double fuzzifier) {
  return fuzzifier == 2.0 ? u * u : std::pow(u, fuzzifier);
}

// Eqs. (7) to (9). A cluster without weight is not changed; one without direction keeps its angle.
FuzzyLine updated(const FuzzyLine& before, const PointMoments& moments) {
  if (!(moments.weight() > std::numeric_limits<double>::min())) return before;
  FuzzyLine line = before;
  const LineFit fit = fit_line(moments);
  line.centre = fit.centroid;                     // eq. (9)
  if (!fit.degenerate) line.normal = fit.normal;  // eq. (8)
  line.rho = line.normal.dot(line.centre);        // eq. (7)
  return line;
}

// The part of J, eq. (1), that belongs to one prototype, from its moments about the centre.
double cost_of(const FuzzyLine& line, const PointMoments& m, bool penalty) {
  const Vec2& n = line.normal;
  const double across = n.x() * n.x() * m.sxx() + 2.0 * n.x() * n.y() * m.sxy() + n.y() * n.y() * m.syy();
  return std::max(across, 0.0) + (penalty ? m.sxx() + m.syy() : 0.0);
}

// Step 4. The paper limits the changes of rho and alpha. Here rho is measured about the new centre: about the sensor, a
// rotation by alpha_tolerance changes rho in proportion to the distance of the wall, and the number of iterations would
// depend on the frame.
bool changed(const FuzzyLine& before, const FuzzyLine& after, const FuzzyOptions& options) {
  return std::fabs(before.normal.dot(after.centre) - before.rho) > options.rho_tolerance_m ||
         std::fabs(cross(before.normal, after.normal)) > std::sin(options.alpha_tolerance_rad);
}

// Step 2 for any number of lines. Sets the memberships and the clusters' moments; returns J.
double membership_step(std::span<const Vec2> points, const FuzzyOptions& options, std::span<const FuzzyLine> lines,
                       std::vector<double>& memberships, std::vector<PointMoments>& moments) {
  std::vector<double> d2(lines.size());
  std::vector<double> u(lines.size());
  std::fill(moments.begin(), moments.end(), PointMoments{});
  double cost = 0.0;
  for (std::size_t j = 0; j < points.size(); ++j) {
    for (std::size_t i = 0; i < lines.size(); ++i) d2[i] = squared_distance(lines[i], points[j], options.penalty);
    memberships_of(d2, options.fuzzifier, u);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const double w = power(u[i], options.fuzzifier);
      memberships[i * points.size() + j] = u[i];
      moments[i].add(points[j], w);
      cost += w * d2[i];
    }
  }
  return cost;
}

// Step 2 for two lines and the fuzzifier 2, several points at a time. The moments are those of membership_step() but
// for rounding: two passes instead of Welford's update, whose divisions wait for each other.
class TwoClusters {
 public:
  TwoClusters(std::span<const Vec2> points, bool penalty)
      : count_(points.size()),
        kernels_(build_for(best_isa(), baseline::kFuzzyKernels, v3::kFuzzyKernels)),
        penalty_(penalty) {
    const std::size_t padded = (count_ + kFuzzyLanes - 1) / kFuzzyLanes * kFuzzyLanes;
    for (std::vector<double>* array : {&x_, &y_, &u_[0], &u_[1]}) array->resize(padded);
    for (std::size_t j = 0; j < count_; ++j) {
      x_[j] = points[j].x();
      y_[j] = points[j].y();
    }
  }

  double step(std::span<const FuzzyLine> lines, std::span<PointMoments> moments) {
    TwoLines two{};
    two.penalty = penalty_;
    for (std::size_t i = 0; i < 2; ++i) {
      two.normal_x[i] = lines[i].normal.x();
      two.normal_y[i] = lines[i].normal.y();
      two.rho[i] = lines[i].rho;
      two.centre_x[i] = lines[i].centre.x();
      two.centre_y[i] = lines[i].centre.y();
    }
    const PointArrays points{x_.data(), y_.data(), static_cast<int>(count_)};
    double* const u[] = {u_[0].data(), u_[1].data()};
    const TwoMeans means = kernels_.memberships(points, two, u);
    double centre_x[2], centre_y[2];
    for (std::size_t i = 0; i < 2; ++i) {
      const bool has_weight = means.weight[i] > 0;
      centre_x[i] = two.centre_x[i] + (has_weight ? means.x[i] / means.weight[i] : 0.0);
      centre_y[i] = two.centre_y[i] + (has_weight ? means.y[i] / means.weight[i] : 0.0);
    }
    const TwoMoments second = kernels_.moments(points, u, centre_x, centre_y);
    for (std::size_t i = 0; i < 2; ++i)
      moments[i] =
          PointMoments::given(means.weight[i], {centre_x[i], centre_y[i]}, second.xx[i], second.xy[i], second.yy[i]);
    return means.cost;
  }

  void copy_memberships(std::vector<double>& out) const {
    for (std::size_t i = 0; i < 2; ++i)
      std::copy_n(u_[i].begin(), count_, out.begin() + static_cast<std::ptrdiff_t>(i * count_));
  }

 private:
  std::size_t count_;
  const FuzzyKernels& kernels_;
  bool penalty_;
  std::vector<double> x_, y_;
  std::array<std::vector<double>, 2> u_;
};

}  // namespace

FuzzyLines fuzzy_lines(std::span<const Vec2> points, std::span<const FuzzyLine> initial, const FuzzyOptions& options) {
  if (!(options.fuzzifier > 1.0)) throw ParamError("fuzzifier", "the fuzzifier must be above 1");
  const std::size_t lines = initial.size();
  FuzzyLines result;
  result.lines.assign(initial.begin(), initial.end());
  result.memberships.assign(lines * points.size(), 0.0);
  if (lines == 0 || points.empty()) {
    result.converged = true;
    return result;
  }
  std::vector<PointMoments> moments(lines);
  // SMF calls this with two lines and, by default, the fuzzifier 2.
  std::optional<TwoClusters> two;
  if (lines == 2 && options.fuzzifier == 2.0) two.emplace(points, options.penalty);
  while (!result.converged && result.iterations < options.max_iterations) {
    // Step 2: memberships, with the centres of the last step 3. Eq. (6) minimises J exactly for fixed prototypes, and
    // eqs. (7) to (9) do for fixed memberships, so J cannot increase.
    result.costs.push_back(two ? two->step(result.lines, moments)
                               : membership_step(points, options, result.lines, result.memberships, moments));

    // Steps 3 and 4: prototypes, and whether one of them still moves.
    result.converged = true;
    double cost = 0.0;
    for (std::size_t i = 0; i < lines; ++i) {
      const FuzzyLine next = updated(result.lines[i], moments[i]);
      if (changed(result.lines[i], next, options)) result.converged = false;
      result.lines[i] = next;
      cost += cost_of(next, moments[i], options.penalty);
    }
    result.costs.push_back(cost);
    ++result.iterations;
  }
  if (two && result.iterations > 0) two->copy_memberships(result.memberships);
  return result;
}

FuzzyLine prototype_of(std::span<const Vec2> points, const Vec2& normal_if_undefined) {
  const LineFit fit = fit_line(points);
  const Vec2 normal = fit.degenerate ? normal_if_undefined : fit.normal;
  return {normal, normal.dot(fit.centroid), fit.centroid};
}

}  // namespace scanbench::extract
