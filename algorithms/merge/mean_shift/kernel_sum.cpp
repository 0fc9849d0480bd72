// Sums of a truncated Gaussian kernel in float, four lanes (Lakaemper 2009, eq. 1).
#include "algorithms/merge/mean_shift/kernel_sum.hpp"

#include <bit>

namespace scanbench::merge {
namespace {

constexpr float kFar = 1e12F;  // its square is finite and beyond any cut-off

Float4 all(float v) {
  return Float4{v, v, v, v};
}

float total(Float4 v) {
  return (v[0] + v[2]) + (v[1] + v[3]);
}

inline Float4 gaussian_lanes(Float4 squared) {
  // exp(-s / 2) = 2^n 2^f with |f| <= 1/2; adding 1.5 * 2^23 rounds to the nearest integer and leaves it in the low
  // bits. 2^f: Taylor polynomial of degree 5, remainder below (ln 2 / 2)^6 / 6! = 2.5e-6.
  const Float4 y = squared * all(-0.72134752F);
  const Float4 rounded = y + all(12582912.0F);
  const Float4 f = y - (rounded - all(12582912.0F));
  Float4 p = all(0.0013333558F);
  p = p * f + all(0.0096181291F);
  p = p * f + all(0.0555041087F);
  p = p * f + all(0.2402265070F);
  p = p * f + all(0.6931471806F);
  p = p * f + all(1.0F);
  return std::bit_cast<Float4>(std::bit_cast<Word4>(p) + (std::bit_cast<Word4>(rounded) << 23));
}

}  // namespace

Float4 gaussian(Float4 squared) {
  return gaussian_lanes(squared);
}

void CandidateList::clear() {
  blocks_.clear();
  filled_ = 4;
}

void CandidateList::add(Float3 p) {
  if (filled_ == 4) {
    blocks_.push_back({all(kFar), all(kFar), all(kFar)});
    filled_ = 0;
  }
  Block& block = blocks_.back();
  block.x[filled_] = p.x;
  block.y[filled_] = p.y;
  block.z[filled_] = p.z;
  ++filled_;
}

void CandidateList::seal() {
  filled_ = 4;
}

Shift CandidateList::shift(Float3 t, float squared_cutoff) const {
  const Float4 tx = all(t.x);
  const Float4 ty = all(t.y);
  const Float4 tz = all(t.z);
  const Float4 cut = all(squared_cutoff);
  Float4 mass = all(0.0F);
  Float4 sx = all(0.0F);
  Float4 sy = all(0.0F);
  Float4 sz = all(0.0F);
  for (const Block& b : blocks_) {
    const Float4 dx = b.x - tx;
    const Float4 dy = b.y - ty;
    const Float4 dz = b.z - tz;
    const Float4 squared = dx * dx + dy * dy + dz * dz;
    const auto inside = squared <= cut;  // lanes of all ones or all zeros
    const auto w = std::bit_cast<Float4>(std::bit_cast<Word4>(gaussian_lanes(squared)) & std::bit_cast<Word4>(inside));
    mass += w;
    sx += w * dx;
    sy += w * dy;
    sz += w * dz;
  }
  Shift result{total(mass), {}};
  if (result.mass > 0.0F) result.step = {total(sx) / result.mass, total(sy) / result.mass, total(sz) / result.mass};
  return result;
}

ShiftAndCovariance CandidateList::shift_and_covariance(Float3 t, float squared_cutoff) const {
  const Float4 tx = all(t.x);
  const Float4 ty = all(t.y);
  const Float4 tz = all(t.z);
  const Float4 cut = all(squared_cutoff);
  const Float4 at_cutoff = gaussian_lanes(cut);
  Float4 mass = all(0.0F), density = mass, sx = mass, sy = mass, sz = mass;
  Float4 xx = mass, xy = mass, xz = mass, yy = mass, yz = mass, zz = mass;
  for (const Block& b : blocks_) {
    const Float4 dx = b.x - tx;
    const Float4 dy = b.y - ty;
    const Float4 dz = b.z - tz;
    const Float4 squared = dx * dx + dy * dy + dz * dz;
    const auto inside = std::bit_cast<Word4>(squared <= cut);
    const Float4 full = gaussian_lanes(squared);
    const auto w = std::bit_cast<Float4>(std::bit_cast<Word4>(full) & inside);
    density += std::bit_cast<Float4>(std::bit_cast<Word4>(full - at_cutoff) & inside);

    const Float4 wx = w * dx;
    const Float4 wy = w * dy;
    const Float4 wz = w * dz;
    mass += w;
    sx += wx;
    sy += wy;
    sz += wz;
    xx += wx * dx;
    xy += wx * dy;
    xz += wx * dz;
    yy += wy * dy;
    yz += wy * dz;
    zz += wz * dz;
  }
  ShiftAndCovariance result;
  const float m = total(mass);
  if (!(m > 0.0F)) return result;
  const Float3 s{total(sx) / m, total(sy) / m, total(sz) / m};
  result.shift = {m, s};
  result.density = total(density);
  result.xx = total(xx) / m - s.x * s.x;
  result.xy = total(xy) / m - s.x * s.y;
  result.xz = total(xz) / m - s.x * s.z;
  result.yy = total(yy) / m - s.y * s.y;
  result.yz = total(yz) / m - s.y * s.z;
  result.zz = total(zz) / m - s.z * s.z;
  return result;
}

}  // namespace scanbench::merge
