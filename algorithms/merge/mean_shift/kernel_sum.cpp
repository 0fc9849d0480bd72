// Candidates of a box, and the mean shift from the sums over them (Lakaemper 2009, eq. 1).
#include "algorithms/merge/mean_shift/kernel_sum.hpp"

#include <algorithm>

namespace scanbench::merge {
namespace {

constexpr float kFar = 1e12F;  // its square is finite and beyond any cut-off

}  // namespace

CandidateList::CandidateList(Isa isa) : kernels_(&build_for(isa, baseline::kSumKernels, v3::kSumKernels)) {}

void CandidateList::clear() {
  count_ = 0;
}

void CandidateList::make_space(std::size_t more) {
  if (count_ + more <= x_.size()) return;
  const std::size_t size = std::max(count_ + more, 2 * x_.size());
  for (std::vector<float>* array : {&x_, &y_, &z_}) array->resize(size);
}

void CandidateList::add(Float3 p) {
  make_space(1);
  x_[count_] = p.x;
  y_[count_] = p.y;
  z_[count_] = p.z;
  ++count_;
}

void CandidateList::add_near(const PointGrid& grid, const Vec3& centre, const Vec3& half, double radius) {
  const NearBox box{
      {centre.x(), centre.y(), centre.z()}, {half.x(), half.y(), half.z()}, radius * radius, grid.period()};
  grid.for_each_run(centre, half, radius, [&](std::size_t begin, std::size_t end) {
    make_space(end - begin + kNearLanes);
    count_ += static_cast<std::size_t>(kernels_->select(grid.x().data() + begin, grid.y().data() + begin,
                                                        grid.z().data() + begin, static_cast<int>(end - begin), box,
                                                        x_.data() + count_, y_.data() + count_, z_.data() + count_));
  });
}

void CandidateList::seal() {
  while (count_ % kSumLanes != 0) add({kFar, kFar, kFar});
}

Shift CandidateList::shift(Float3 t, float squared_cutoff) const {
  const float at[] = {t.x, t.y, t.z};
  const FirstSums s = kernels_->first(arrays(), at, squared_cutoff);
  Shift result{s.mass, {}};
  if (s.mass > 0.0F) result.step = {s.x / s.mass, s.y / s.mass, s.z / s.mass};
  return result;
}

ShiftAndCovariance CandidateList::shift_and_covariance(Float3 t, float squared_cutoff) const {
  const float at[] = {t.x, t.y, t.z};
  const SecondSums sums = kernels_->second(arrays(), at, squared_cutoff);
  ShiftAndCovariance result;
  const float m = sums.first.mass;
  if (!(m > 0.0F)) return result;
  const Float3 s{sums.first.x / m, sums.first.y / m, sums.first.z / m};
  result.shift = {m, s};
  result.density = sums.density;
  result.xx = sums.xx / m - s.x * s.x;
  result.xy = sums.xy / m - s.x * s.y;
  result.xz = sums.xz / m - s.x * s.z;
  result.yy = sums.yy / m - s.y * s.y;
  result.yz = sums.yz / m - s.y * s.z;
  result.zz = sums.zz / m - s.z * s.z;
  return result;
}

}  // namespace scanbench::merge
