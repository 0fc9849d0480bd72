// A walk over the beams on both sides of a bearing, and nanoflann behind it.
//
// A return on a ray cannot be nearer to a point than the ray is. Bearings grow along the scan, so once the rays of one
// side are farther away than the best return, so are all behind them: no table is needed to know when to stop.
#include "algorithms/match/parts/nearest_return.hpp"

#include <array>
#include <cmath>
#include <nanoflann.hpp>

namespace scanbench::matching {
namespace {

constexpr int kFewBeams = 48;  // on both sides together; a search of the tree costs about as much

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

}  // namespace

class NearestReturn::Tree {
 public:
  explicit Tree(const std::vector<Vec2>& points) : set_{points}, index_(2, set_, {10}) { index_.buildIndex(); }
  std::optional<std::size_t> find(const Vec2& p, double gate_m) const {
    std::size_t index = 0;
    double square = 0.0;
    nanoflann::KNNResultSet<double> best(1);
    best.init(&index, &square);
    const std::array<double, 2> query{p.x(), p.y()};
    index_.findNeighbors(best, query.data(), nanoflann::SearchParams());
    if (best.size() == 0 || square > gate_m * gate_m) return std::nullopt;
    return index;
  }

 private:
  PointSet set_;
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PointSet>, PointSet, 2> index_;
};

NearestReturn::NearestReturn(const ReturnedPoints& scan)
    : scan_(scan), sense_(scan.scan.sensor.geometry.angle_step() < 0 ? -1.0 : 1.0) {}
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
  for (std::size_t steps = 0; steps < n && sense_ * cross(scan_.direction(next(k)), p) > 0; ++steps) k = next(k);
  for (std::size_t steps = 0; steps < n && sense_ * cross(scan_.direction(k), p) < 0; ++steps) k = previous(k);
  return k;
}

std::optional<std::size_t> NearestReturn::find(const Vec2& p, double gate_m, std::size_t hint) {
  const std::size_t n = scan_.size();
  if (n == 0) return std::nullopt;
  double best = gate_m * gate_m;
  std::optional<std::size_t> found;
  const auto look_at = [&](std::size_t k) {
    const double square = (scan_.points[k] - p).squaredNorm();
    if (square > best || (square == best && found)) return;
    best = square;
    found = k;
  };
  std::size_t down = at_bearing(p, hint), up = next(down);
  bool open_down = true, open_up = true;
  std::size_t left = n;
  for (int looked = 0; left > 0 && (open_down || open_up); looked += 2) {
    if (looked >= kFewBeams) {
      if (!tree_) tree_ = std::make_unique<Tree>(scan_.points);
      return tree_->find(p, gate_m);
    }
    if (open_down) {
      open_down = square_from_ray(p, scan_.direction(down)) <= best;
      if (open_down) {
        look_at(down);
        down = previous(down);
        --left;
      }
    }
    if (open_up && left > 0) {
      open_up = square_from_ray(p, scan_.direction(up)) <= best;
      if (open_up) {
        look_at(up);
        up = next(up);
        --left;
      }
    }
  }
  return found;
}

}  // namespace scanbench::matching
