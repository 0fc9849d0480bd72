// A walk over the beams on both sides of a bearing, and nanoflann behind it.
//
// A return on a ray cannot be nearer to a point than the ray is. Bearings grow along the scan, so once the rays of one
// side are farther away than the best return, so are all behind them: no table is needed to know when to stop.
#include "algorithms/match/parts/nearest_return.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nanoflann.hpp>

namespace scanbench::matching {
namespace {

constexpr std::size_t kFewBeams = 48;  // on both sides together; a search of the tree costs about as much

/// The interface to a set of points that nanoflann needs.
struct PointSet {
  const std::vector<Vec2>& points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][static_cast<Eigen::Index>(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

/// Square of the distance of p from the ray.
double square_from_ray(const Vec2& p, const Vec2& direction) {
  if (!(direction.dot(p) > 0)) return p.squaredNorm();
  const double d = cross(direction, p);
  return d * d;
}

/// The two nearest of the returns that were looked at. Without branches: which of two returns is nearer is chance.
class TwoNearest {
 public:
  explicit TwoNearest(double gate_m)
      : square_(gate_m * gate_m * (1.0 + std::numeric_limits<double>::epsilon())), others_square_(square_) {}
  void look_at(std::size_t index, double square) {
    others_square_ = std::min(others_square_, std::max(square_, square));
    index_ = square < square_ ? index : index_;
    square_ = std::min(square_, square);
  }
  /// Square of the distance beyond which nothing changes.
  double reach() const { return others_square_; }
  std::optional<Nearest> result(double gate_m) const {
    const double gate_square = gate_m * gate_m;
    if (index_ == Track::kNone || square_ > gate_square) return std::nullopt;
    return Nearest{index_, square_, std::min(others_square_, gate_square)};
  }

 private:
  double square_;
  double others_square_;
  std::size_t index_ = Track::kNone;
};

}  // namespace

class NearestReturn::Tree {
 public:
  explicit Tree(const std::vector<Vec2>& points) : set_{points}, index_(2, set_, {10}) { index_.buildIndex(); }
  std::optional<Nearest> find(const Vec2& p, double gate_m) const {
    std::array<std::size_t, 2> indices{};
    std::array<double, 2> squares{};
    nanoflann::KNNResultSet<double> best(2);
    best.init(indices.data(), squares.data());
    const std::array<double, 2> query{p.x(), p.y()};
    index_.findNeighbors(best, query.data(), nanoflann::SearchParams());
    TwoNearest found(gate_m);
    for (std::size_t k = 0; k < best.size(); ++k) found.look_at(indices[k], squares[k]);
    return found.result(gate_m);
  }

 private:
  PointSet set_;
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PointSet>, PointSet, 2> index_;
};

NearestReturn::NearestReturn(const ReturnedPoints& scan)
    : scan_(scan), sense_(scan.scan.sensor.geometry.angle_step() < 0 ? -1.0 : 1.0) {
  rays_.reserve(scan.size());
  for (std::size_t k = 0; k < scan.size(); ++k) rays_.push_back({scan.direction(k), scan.points[k]});
}
NearestReturn::~NearestReturn() = default;

/// The return whose beam is the last at or before the bearing of p, counted in the sense of the scan.
std::size_t NearestReturn::at_bearing(const Vec2& p, std::size_t hint) const {
  const std::size_t n = scan_.size();
  std::size_t k = hint;
  if (k >= n) {
    const ScanGeometry& geometry = scan_.scan.sensor.geometry;
    const double turn = std::remainder(std::atan2(p.y(), p.x()) - geometry.angle_min(), kTwoPi);
    const double step = geometry.angle_step();
    double beam = step != 0 ? turn / step : 0.0;
    if (beam < 0 && step != 0) beam += kTwoPi / std::fabs(step);
    const auto behind = std::upper_bound(scan_.beams.begin(), scan_.beams.end(), beam,
                                         [](double value, int b) { return value < static_cast<double>(b); });
    return behind == scan_.beams.begin() ? n - 1 : static_cast<std::size_t>(behind - scan_.beams.begin()) - 1;
  }
  // From the hint on while the point is on the far side of the next ray, back while it is on the near side of this one.
  for (std::size_t steps = 0; steps < n && sense_ * cross(rays_[next(k)].direction, p) > 0; ++steps) k = next(k);
  for (std::size_t steps = 0; steps < n && sense_ * cross(rays_[k].direction, p) < 0; ++steps) k = previous(k);
  return k;
}

std::optional<Nearest> NearestReturn::find(const Vec2& p, double gate_m, std::size_t hint) {
  if (rays_.empty()) return std::nullopt;
  TwoNearest nearest(gate_m);
  std::size_t left = rays_.size();
  const auto look_at = [&](std::size_t k) {
    nearest.look_at(k, (rays_[k].point - p).squaredNorm());
    --left;
  };
  const auto within_reach = [&](std::size_t k) {
    return left > 0 && square_from_ray(p, rays_[k].direction) <= nearest.reach();
  };
  // Both neighbours of the bearing first: they tell how far the walk has to go.
  std::size_t down = at_bearing(p, hint), up = next(down);
  if (within_reach(down)) look_at(down);
  if (within_reach(up)) look_at(up);
  const std::size_t enough = left > kFewBeams ? left - kFewBeams : 0;
  for (down = previous(down); within_reach(down) && left > enough; down = previous(down)) look_at(down);
  for (up = next(up); within_reach(up) && left > enough; up = next(up)) look_at(up);
  if (left > 0 && left == enough) {
    if (!tree_) tree_ = std::make_unique<Tree>(scan_.points);
    return tree_->find(p, gate_m);
  }
  return nearest.result(gate_m);
}

std::optional<std::size_t> NearestReturn::follow(const Vec2& p, double gate_m, Track& track) {
  if (track.partner < rays_.size()) {
    // The others are at least so far away now as then, less the motion. The partner is the nearest if its distance and
    // the motion together are less than that: d + m < o, squared twice. The partner is then within the gate, because o
    // is at most the gate.
    const double motion = (p - track.searched_at).squaredNorm();
    const double distance = (rays_[track.partner].point - p).squaredNorm();
    const double rest = track.others_square - motion - distance;
    if (rest > 0 && 4.0 * motion * distance < rest * rest) return track.partner;
  }
  const std::optional<Nearest> found = find(p, gate_m, track.partner);
  if (!found) {
    track.others_square = -1.0;
    return std::nullopt;
  }
  track = {p, found->index, found->others_square};
  return found->index;
}

}  // namespace scanbench::matching
