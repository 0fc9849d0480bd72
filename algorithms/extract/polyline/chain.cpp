// Levenberg-Marquardt fit of the vertices of a chain. docs/algorithms/polyline.md, section 3.
#include "algorithms/extract/polyline/chain.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/angles.hpp"
#include "core/geometry/symmetric_matrix.hpp"
#include "core/index.hpp"
#include "core/special_values.hpp"

namespace scanbench::extract {
namespace {

constexpr double kLeastStep = 1e-9;  // between the bearings of two vertices [rad]
constexpr double kMostStep = 3.0;

bool is_chain(const Chain& chain) {
  for (int k = 0; k < chain.walls(); ++k) {
    const double step = chain.vertex(k + 1).bearing_rad - chain.vertex(k).bearing_rad;
    if (!(step >= kLeastStep && step <= kMostStep)) return false;
  }
  return std::ranges::all_of(chain.vertices, [](const ChainVertex& v) { return v.inverse_range > 0; });
}

struct NormalEquations {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd rhs;
};

// Normal equations of the residuals (z - r) / sigma for the (bearing, inverse range) of all vertices.
NormalEquations normal_equations(const Chain& chain, std::span<const BearingReading> readings) {
  const auto size = static_cast<Eigen::Index>(2 * chain.vertices.size());
  NormalEquations n{Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size)};
  for (const BearingReading& z : readings) {
    const double bearing = within(chain, z.bearing_rad);
    const int k = chain.wall_at(bearing);
    const ChainVertex p = chain.vertex(k), q = chain.vertex(k + 1);
    const double step = q.bearing_rad - p.bearing_rad;
    const double sine = std::sin(step);
    const double from_p = std::sin(q.bearing_rad - bearing) / sine;
    const double from_q = std::sin(bearing - p.bearing_rad) / sine;
    const double u = from_p * p.inverse_range + from_q * q.inverse_range;
    // If only the bearing of a vertex changes, it leaves the wall by minus the wall's slope there.
    const double slope_p = (q.inverse_range - p.inverse_range * std::cos(step)) / sine;
    const double slope_q = (q.inverse_range * std::cos(step) - p.inverse_range) / sine;
    const double r = 1.0 / u;
    const double scale = -r * r / z.sigma_m;  // derivative of the range by the inverse range, in standard deviations
    const std::array<double, 4> g = {-slope_p * from_p * scale, from_p * scale, -slope_q * from_q * scale,
                                     from_q * scale};
    const double error = (z.range_m - r) / z.sigma_m;
    const Eigen::Index i = Eigen::Index{2} * k;
    const Eigen::Index j = Eigen::Index{2} * ((k + 1) % static_cast<int>(chain.vertices.size()));
    const std::array<Eigen::Index, 4> index = {i, i + 1, j, j + 1};
    for (std::size_t a = 0; a < 4; ++a) {
      n.rhs[index[a]] += g[a] * error;
      for (std::size_t b = 0; b < 4; ++b) n.matrix(index[a], index[b]) += g[a] * g[b];
    }
  }
  if (!chain.closed) {  // the ends keep their bearings
    for (const Eigen::Index fixed : {Eigen::Index{0}, size - 2}) {
      n.matrix.row(fixed).setZero();
      n.matrix.col(fixed).setZero();
      n.rhs[fixed] = 0.0;
    }
  }
  return n;
}

Chain moved(Chain chain, const Eigen::VectorXd& step) {
  for (std::size_t k = 0; k < chain.vertices.size(); ++k) {
    chain.vertices[k].bearing_rad += step[static_cast<Eigen::Index>(2 * k)];
    chain.vertices[k].inverse_range += step[static_cast<Eigen::Index>(2 * k + 1)];
  }
  return chain;
}

// Inverse of the information; 0 in the directions without information.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& information) {
  const Eigen::VectorXd scale = information.diagonal().cwiseSqrt().unaryExpr([](double x) { return x > 0 ? x : 1.0; });
  const Eigen::MatrixXd scaled = scale.cwiseInverse().asDiagonal() * information * scale.cwiseInverse().asDiagonal();
  const SymmetricEigen<Eigen::MatrixXd> eigen = symmetric_eigen(scaled);
  const double least = 1e-10 * eigen.values.maxCoeff();
  const Eigen::VectorXd inverse = eigen.values.unaryExpr([least](double x) { return x > least ? 1.0 / x : 0.0; });
  const Eigen::MatrixXd v = scale.cwiseInverse().asDiagonal() * eigen.vectors;
  return v * inverse.asDiagonal() * v.transpose();
}

}  // namespace

ChainVertex Chain::vertex(int k) const {
  if (k < static_cast<int>(vertices.size())) return vertices[as_index(k)];
  ChainVertex v = vertices[as_index(k) - vertices.size()];
  v.bearing_rad += kTwoPi;
  return v;
}

int Chain::wall_at(double bearing_rad) const {
  const auto after = std::ranges::upper_bound(vertices, bearing_rad, {}, &ChainVertex::bearing_rad);
  const int k = static_cast<int>(after - vertices.begin()) - 1;
  return std::clamp(k, 0, std::max(walls() - 1, 0));
}

double Chain::inverse_range(int wall, double bearing_rad) const {
  const ChainVertex p = vertex(wall), q = vertex(wall + 1);
  return (p.inverse_range * std::sin(q.bearing_rad - bearing_rad) +
          q.inverse_range * std::sin(bearing_rad - p.bearing_rad)) /
         std::sin(q.bearing_rad - p.bearing_rad);
}

double Chain::slope(int wall, double bearing_rad) const {
  const ChainVertex p = vertex(wall), q = vertex(wall + 1);
  const double u = inverse_range(wall, bearing_rad);
  const double du = (q.inverse_range * std::cos(bearing_rad - p.bearing_rad) -
                     p.inverse_range * std::cos(q.bearing_rad - bearing_rad)) /
                    std::sin(q.bearing_rad - p.bearing_rad);
  return -du / (u * u);
}

double within(const Chain& chain, double bearing_rad) {
  if (!chain.closed) return bearing_rad;
  const double first = chain.vertices.front().bearing_rad;
  return bearing_rad - kTwoPi * std::floor((bearing_rad - first) / kTwoPi);
}

double half_squares(const Chain& chain, std::span<const BearingReading> readings) {
  double sum = 0.0;
  for (const BearingReading& z : readings) {
    const double bearing = within(chain, z.bearing_rad);
    const double u = chain.inverse_range(chain.wall_at(bearing), bearing);
    if (!(u > 0)) return kInf;
    const double e = (z.range_m - 1.0 / u) / z.sigma_m;
    sum += 0.5 * e * e;
  }
  return sum;
}

ChainFit fit_chain(const Chain& start, std::span<const BearingReading> readings) {
  ChainFit fit{.chain = start, .half_squares = half_squares(start, readings), .covariance = {}};
  NormalEquations n = normal_equations(fit.chain, readings);
  double damping = 1e-3;
  for (int iteration = 0; iteration < 200 && damping < 1e12; ++iteration) {
    Eigen::MatrixXd damped = n.matrix;
    for (Eigen::Index i = 0; i < damped.rows(); ++i) damped(i, i) += damping * n.matrix(i, i) + 1e-300;
    // A vertex that no reading sees does not move.
    for (Eigen::Index i = 0; i < damped.rows(); ++i)
      if (!(n.matrix(i, i) > 0)) damped(i, i) = 1.0;
    const Eigen::VectorXd step = solve_definite(damped, n.rhs);
    const Chain next = moved(fit.chain, step);
    const double squares = step.allFinite() && is_chain(next) ? half_squares(next, readings) : kInf;
    if (!(squares < fit.half_squares)) {
      damping *= 4.0;
      continue;
    }
    const double gain = fit.half_squares - squares;
    fit.chain = next;
    fit.half_squares = squares;
    n = normal_equations(fit.chain, readings);
    damping = std::max(damping / 5.0, 1e-12);
    if (gain <= 1e-9 * squares + 1e-18) break;
  }
  fit.covariance = pseudo_inverse(n.matrix);
  return fit;
}

}  // namespace scanbench::extract
