// Forces eight pairs at a time over the runs of a cell grid; each pair is computed once and acts on both of its
// points.
//
// Only + - * and bit operations on single-precision lanes in a fixed order: the sums do not depend on how wide the
// registers are that the compiler has for eight lanes. What is left out: the CPU's own estimates of reciprocal roots,
// which differ between makers.
#include "algorithms/align/ffs/force_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

#include "algorithms/align/parts/cell_grid.hpp"

// Eight lanes in narrower registers change how vectors are passed between functions; all of these are inlined.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace scanbench::align::ffs {
namespace {

constexpr std::size_t kLanes = 8;
using Floats [[gnu::vector_size(4 * kLanes)]] = float;
using Ints [[gnu::vector_size(4 * kLanes)]] = std::int32_t;
using Words [[gnu::vector_size(4 * kLanes)]] = std::uint32_t;  ///< the same as Ints, for sums that may wrap around
using Longs [[gnu::vector_size(4 * kLanes)]] = std::int64_t;

/// Points in the order of the cells of the grid, relative to its centre, with the sums of the forces on them.
struct Lanes {
  std::vector<float> x, y;
  std::vector<float> c, s;  ///< direction times weight; the product of two points is w_v w_u cos(angle)
  std::vector<std::int32_t> body;
  std::vector<float> fx, fy, stiffness;
};

struct Pointers {
  const float *x, *y, *c, *s;
  const std::int32_t* body;
  float *fx, *fy, *stiffness;
};

struct Constants {
  float exponent;  ///< -log2(e) / (2 sigma^2)
  float squared_cut;
  float stiffest;  ///< largest 1 / d
};

[[gnu::always_inline]] inline Floats all(float v) {
  return Floats{} + v;
}

[[gnu::always_inline]] inline Ints all(std::int32_t v) {
  return Ints{} + v;
}

/// std::bit_cast, always inlined. A call would pass wide vectors as the default target does, but the callers are
/// compiled for other targets.
template <class To, class From>
[[gnu::always_inline]] inline To bits(const From& from) {
  return __builtin_bit_cast(To, from);
}

[[gnu::always_inline]] inline Ints numbered() {
  Ints lanes{};
  for (std::size_t k = 0; k < kLanes; ++k) lanes[k] = static_cast<std::int32_t>(k);
  return lanes;
}

[[gnu::always_inline]] inline Floats load(const float* from) {
  Floats v;
  std::memcpy(&v, from, sizeof v);
  return v;
}

[[gnu::always_inline]] inline Floats where(Ints mask, Floats v) {
  return bits<Floats>(bits<Ints>(v) & mask);
}

[[gnu::always_inline]] inline bool none(Ints mask) {
  const auto pairs = bits<Longs>(mask);
  std::int64_t any = 0;
  for (std::size_t k = 0; k < kLanes / 2; ++k) any |= pairs[k];
  return any == 0;
}

[[gnu::always_inline]] inline void subtract(float* from, Floats v) {
  const Floats left = load(from) - v;
  std::memcpy(from, &left, sizeof left);
}

[[gnu::always_inline]] inline float total(Floats v) {
  float sum[kLanes];
  std::memcpy(sum, &v, sizeof v);
  for (std::size_t half = kLanes / 2; half > 0; half /= 2)
    for (std::size_t k = 0; k < half; ++k) sum[k] += sum[k + half];
  return sum[0];
}

/// 2^y for -126 < y <= 0; undefined for other y. 2^y = 2^n 2^f with |f| <= 1/2. Adding 1.5 * 2^23 rounds to the nearest
/// integer, which is then in the low bits. 2^f is a Taylor polynomial of degree 5 with a remainder below (ln 2 / 2)^6 /
/// 6! = 2.5e-6.
[[gnu::always_inline]] inline Floats power_of_two(Floats y) {
  const Floats rounded = y + all(12582912.0F);
  const Floats f = y - (rounded - all(12582912.0F));
  Floats p = all(0.0013333558F);
  p = p * f + all(0.0096181291F);
  p = p * f + all(0.0555041087F);
  p = p * f + all(0.2402265070F);
  p = p * f + all(0.6931471806F);
  p = p * f + all(1.0F);
  return bits<Floats>(bits<Words>(p) + (bits<Words>(rounded) << 23));
}

/// 1 / sqrt(v) with a relative error below 5e-6; finite for 0. An estimate from the exponent is improved by two Newton
/// steps.
[[gnu::always_inline]] inline Floats reciprocal_root(Floats v) {
  auto r = bits<Floats>(all(std::int32_t{0x5f3759df}) - (bits<Ints>(v) >> 1));
  const Floats half = v * all(0.5F);
  r = r * (all(1.5F) - half * r * r);
  return r * (all(1.5F) - half * r * r);
}

/// Computes the pairs of point i with the points at places begin .. end - 1, which all come after i. Arrays extend
/// kLanes beyond their last point.
[[gnu::always_inline]] inline void attract(const Pointers& p, const Constants& k, std::size_t i, std::size_t begin,
                                           std::size_t end) {
  const Floats x = all(p.x[i]), y = all(p.y[i]), c = all(p.c[i]), s = all(p.s[i]);
  const std::int32_t own = p.body[i];
  const Ints body = all(own);
  const Ints lane = numbered();
  Floats fx = all(0.0F), fy = all(0.0F), stiffness = all(0.0F);
  for (std::size_t j = begin; j < end; j += kLanes) {
    const Floats dx = load(p.x + j) - x, dy = load(p.y + j) - y;
    const Floats squared = dx * dx + dy * dy;
    Ints others;
    std::memcpy(&others, p.body + j, sizeof others);
    const auto left = static_cast<std::int32_t>(end - j);
    const Ints limit = all(left);
    const Ints acts = (others != body) & (squared <= all(k.squared_cut)) & (lane < limit);
    if (none(acts)) continue;  // adjacent points are often of one body; this skips half of all blocks
    const Ints magnitude = bits<Ints>(c * load(p.c + j) + s * load(p.s + j)) & 0x7fffffff;            // |w w cos|
    const Floats m = where(acts, bits<Floats>(magnitude) * power_of_two(squared * all(k.exponent)));  // (2)
    const Floats inverse = reciprocal_root(squared);
    const Floats spring = m * (inverse < all(k.stiffest) ? inverse : all(k.stiffest));
    const Floats gx = spring * dx, gy = spring * dy;  // (1)
    fx += gx;
    fy += gy;
    stiffness += spring;
    subtract(p.fx + j, gx);  // action = reaction
    subtract(p.fy + j, gy);
    subtract(p.stiffness + j, -spring);
  }
  p.fx[i] += total(fx);
  p.fy[i] += total(fy);
  p.stiffness[i] += total(stiffness);
}

[[gnu::always_inline]] inline void all_pairs(const CellGrid& grid, const Pointers& p, const Constants& k) {
  const int around = grid.around();
  for (int row = 0; row < grid.rows(); ++row)
    for (int column = 0; column < grid.columns(); ++column) {
      const CellGrid::Run cell = grid.cell(row, column);
      if (cell.begin == cell.end) continue;
      const std::size_t row_end = grid.run(row, column, column + around).end;
      for (std::size_t i = cell.begin; i < cell.end; ++i) attract(p, k, i, i + 1, row_end);
      for (int above = row + 1; above <= row + around; ++above) {
        const CellGrid::Run run = grid.run(above, column - around, column + around);
        for (std::size_t i = cell.begin; i < cell.end; ++i) attract(p, k, i, run.begin, run.end);
      }
    }
}

void all_pairs_plain(const CellGrid& grid, const Pointers& p, const Constants& k) {
  all_pairs(grid, p, k);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void all_pairs_avx2(const CellGrid& grid, const Pointers& p, const Constants& k) {
  all_pairs(grid, p, k);
}
[[gnu::target("avx512f,avx512dq,avx512bw")]] void all_pairs_avx512(const CellGrid& grid, const Pointers& p,
                                                                   const Constants& k) {
  all_pairs(grid, p, k);
}
#endif

using Kernel = void (*)(const CellGrid&, const Pointers&, const Constants&);

Kernel widest_kernel() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"))
    return all_pairs_avx512;
  if (__builtin_cpu_supports("avx2")) return all_pairs_avx2;
#endif
  return all_pairs_plain;
}

Lanes lanes_of(const FieldPoints& points, const CellGrid& grid) {
  const std::size_t n = points.size(), padded = n + kLanes;
  Lanes lanes;
  for (auto* v : {&lanes.x, &lanes.y, &lanes.c, &lanes.s, &lanes.fx, &lanes.fy, &lanes.stiffness}) v->resize(padded);
  lanes.body.assign(padded, -1);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = grid.order()[k];
    const Vec2 at = points.at[i] - grid.middle();
    const Vec2 weighted = points.weight[i] * points.direction[i];
    lanes.x[k] = static_cast<float>(at.x());
    lanes.y[k] = static_cast<float>(at.y());
    lanes.c[k] = static_cast<float>(weighted.x());
    lanes.s[k] = static_cast<float>(weighted.y());
    lanes.body[k] = points.body[i];
  }
  return lanes;
}

double peak(double sigma) {
  return 1.0 / (sigma * std::sqrt(2.0 * std::numbers::pi));
}

}  // namespace

void point_forces(const FieldPoints& points, const Field& field, std::vector<PointForce>& forces) {
  const CellGrid grid(points.at, field.reach());
  Lanes lanes = lanes_of(points, grid);
  const Pointers pointers{lanes.x.data(),    lanes.y.data(),  lanes.c.data(),  lanes.s.data(),
                          lanes.body.data(), lanes.fx.data(), lanes.fy.data(), lanes.stiffness.data()};
  const Constants constants{static_cast<float>(-0.5 * std::numbers::log2e / (field.sigma * field.sigma)),
                            static_cast<float>(field.reach() * field.reach()), static_cast<float>(1.0 / field.soft())};
  static const Kernel kernel = widest_kernel();
  kernel(grid, pointers, constants);
  forces.resize(points.size());
  const double scale = peak(field.sigma);
  for (std::size_t k = 0; k < points.size(); ++k)
    forces[grid.order()[k]] = {scale * Vec2(lanes.fx[k], lanes.fy[k]), scale * static_cast<double>(lanes.stiffness[k])};
}

double stiffness_on_line(double spacing_m, const Field& field) {
  double sum = 0.0;
  const auto points = static_cast<std::int64_t>(field.reach() / spacing_m + 0.5);  // of either side
  for (std::int64_t k = 0; k < points; ++k) {
    const double d = (static_cast<double>(k) + 0.5) * spacing_m;
    sum += 2.0 * std::exp(-0.5 * d * d / (field.sigma * field.sigma)) / std::max(d, field.soft());
  }
  return peak(field.sigma) * sum;
}

double potential(const FieldPoints& points, const Field& field) {
  const CellGrid grid(points.at, field.reach());
  const double scale = 1.0 / (field.sigma * std::numbers::sqrt2), soft = field.soft();
  const auto gauss = [&](double d) { return std::exp(-scale * scale * d * d); };
  double sum = 0.0;
  for (std::size_t v = 0; v < points.size(); ++v)
    grid.for_each_near(points.at[v], [&](std::size_t u) {
      if (u <= v || points.body[u] == points.body[v]) return;
      const double d = (points.at[u] - points.at[v]).norm();
      if (d > field.reach()) return;
      const double aligned = std::fabs(points.direction[u].dot(points.direction[v]));
      double depth = 0.5 * std::erfc(std::max(d, soft) * scale);
      if (d < soft) depth += peak(field.sigma) * field.sigma * field.sigma / soft * (gauss(d) - gauss(soft));
      sum -= points.weight[u] * points.weight[v] * aligned * depth;
    });
  return sum;
}

}  // namespace scanbench::align::ffs
