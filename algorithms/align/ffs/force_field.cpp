// Forces eight pairs at a time over the runs of a cell grid; each pair is computed once and acts on both of its points.
//
// Only + - * and bit operations on single-precision lanes in a fixed order: the sums do not depend on how wide the
// registers are that the compiler has for eight lanes. What is left out: the CPU's own estimates of reciprocal roots,
// which differ between makers.
#include "algorithms/align/ffs/force_field.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

#include "algorithms/align/parts/cell_grid.hpp"

// Eight lanes in registers of four change how vectors are passed between functions; all of these are inlined.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace scanbench::align::ffs {
namespace {

using Float8 [[gnu::vector_size(32)]] = float;
using Int8 [[gnu::vector_size(32)]] = std::int32_t;
using Long4 [[gnu::vector_size(32)]] = std::int64_t;

constexpr std::size_t kLanes = 8;
constexpr double kStiffestSigmas = 0.05;  // below this distance a pair is as stiff as at it

/// Points in the order of the grid's cells, relative to its middle, with the sums of what acts on them.
struct Lanes {
  std::vector<float> x, y;
  std::vector<float> c, s;  ///< direction times weight: products of two points are w_v w_u cos(angle)
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
  float stiffest;  ///< largest 1 / d in stiffness
};

[[gnu::always_inline]] inline Float8 all(float v) {
  return Float8{v, v, v, v, v, v, v, v};
}

[[gnu::always_inline]] inline Float8 load(const float* from) {
  Float8 v;
  std::memcpy(&v, from, sizeof v);
  return v;
}

[[gnu::always_inline]] inline Float8 where(Int8 mask, Float8 v) {
  return std::bit_cast<Float8>(std::bit_cast<Int8>(v) & mask);
}

[[gnu::always_inline]] inline bool none(Int8 mask) {
  const Long4 halves = std::bit_cast<Long4>(mask);
  return ((halves[0] | halves[1]) | (halves[2] | halves[3])) == 0;
}

[[gnu::always_inline]] inline void subtract(float* from, Float8 v) {
  const Float8 left = load(from) - v;
  std::memcpy(from, &left, sizeof left);
}

[[gnu::always_inline]] inline float total(Float8 v) {
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

/// 2^y for -126 < y <= 0; anything elsewhere. 2^y = 2^n 2^f with |f| <= 1/2: adding 1.5 * 2^23 rounds to the nearest
/// integer and leaves it in the low bits; Taylor polynomial of degree 5, remainder below (ln 2 / 2)^6 / 6! = 2.5e-6.
[[gnu::always_inline]] inline Float8 power_of_two(Float8 y) {
  const Float8 rounded = y + all(12582912.0F);
  const Float8 f = y - (rounded - all(12582912.0F));
  Float8 p = all(0.0013333558F);
  p = p * f + all(0.0096181291F);
  p = p * f + all(0.0555041087F);
  p = p * f + all(0.2402265070F);
  p = p * f + all(0.6931471806F);
  p = p * f + all(1.0F);
  return std::bit_cast<Float8>(std::bit_cast<Int8>(p) + (std::bit_cast<Int8>(rounded) << 23));
}

/// 1 / sqrt(v), relative error below 5e-6; finite for 0. A guess from the exponent and two Newton steps.
[[gnu::always_inline]] inline Float8 reciprocal_root(Float8 v) {
  const Int8 magic = {0x5f3759df, 0x5f3759df, 0x5f3759df, 0x5f3759df, 0x5f3759df, 0x5f3759df, 0x5f3759df, 0x5f3759df};
  Float8 r = std::bit_cast<Float8>(magic - (std::bit_cast<Int8>(v) >> 1));
  const Float8 half = v * all(0.5F);
  r = r * (all(1.5F) - half * r * r);
  return r * (all(1.5F) - half * r * r);
}

/// Point i against the points in places begin .. end - 1, all behind i. Arrays reach kLanes beyond their last point.
[[gnu::always_inline]] inline void attract(const Pointers& p, const Constants& k, std::size_t i, std::size_t begin,
                                           std::size_t end) {
  const Float8 x = all(p.x[i]), y = all(p.y[i]), c = all(p.c[i]), s = all(p.s[i]);
  const std::int32_t own = p.body[i];
  const Int8 body = {own, own, own, own, own, own, own, own};
  const Int8 lane = {0, 1, 2, 3, 4, 5, 6, 7};
  Float8 fx = all(0.0F), fy = all(0.0F), stiffness = all(0.0F);
  for (std::size_t j = begin; j < end; j += kLanes) {
    const Float8 dx = load(p.x + j) - x, dy = load(p.y + j) - y;
    const Float8 squared = dx * dx + dy * dy;
    Int8 others;
    std::memcpy(&others, p.body + j, sizeof others);
    const auto left = static_cast<std::int32_t>(end - j);
    const Int8 limit = {left, left, left, left, left, left, left, left};
    const Int8 acts = (others != body) & (squared <= all(k.squared_cut)) & (lane < limit);
    if (none(acts)) continue;  // neighbours in memory are neighbours on a line: half of all blocks
    const Int8 magnitude = std::bit_cast<Int8>(c * load(p.c + j) + s * load(p.s + j)) & 0x7fffffff;  // |w w cos|
    const Float8 m = where(acts, std::bit_cast<Float8>(magnitude) * power_of_two(squared * all(k.exponent)));  // (2)
    const Float8 inverse = reciprocal_root(squared);
    const Float8 gx = m * inverse * dx, gy = m * inverse * dy;  // (1)
    const Float8 spring = m * (inverse < all(k.stiffest) ? inverse : all(k.stiffest));
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
[[gnu::target("avx2")]] void all_pairs_wide(const CellGrid& grid, const Pointers& p, const Constants& k) {
  all_pairs(grid, p, k);
}
bool has_wide_registers() {
  return __builtin_cpu_supports("avx2");
}
#else
void all_pairs_wide(const CellGrid& grid, const Pointers& p, const Constants& k) {
  all_pairs(grid, p, k);
}
bool has_wide_registers() {
  return false;
}
#endif

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
                            static_cast<float>(field.reach() * field.reach()),
                            static_cast<float>(1.0 / (kStiffestSigmas * field.sigma))};
  if (has_wide_registers()) {
    all_pairs_wide(grid, pointers, constants);
  } else {
    all_pairs_plain(grid, pointers, constants);
  }
  forces.resize(points.size());
  const double scale = peak(field.sigma);
  for (std::size_t k = 0; k < points.size(); ++k)
    forces[grid.order()[k]] = {scale * Vec2(lanes.fx[k], lanes.fy[k]), scale * static_cast<double>(lanes.stiffness[k])};
}

double potential(const FieldPoints& points, const Field& field) {
  const CellGrid grid(points.at, field.reach());
  const double scale = 1.0 / (field.sigma * std::numbers::sqrt2);
  double sum = 0.0;
  for (std::size_t v = 0; v < points.size(); ++v)
    grid.for_each_near(points.at[v], [&](std::size_t u) {
      if (u <= v || points.body[u] == points.body[v]) return;
      const double d = (points.at[u] - points.at[v]).norm();
      if (d > field.reach()) return;
      const double aligned = std::fabs(points.direction[u].dot(points.direction[v]));
      sum -= 0.5 * points.weight[u] * points.weight[v] * aligned * std::erfc(d * scale);
    });
  return sum;
}

}  // namespace scanbench::align::ffs
